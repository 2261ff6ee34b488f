// SPDX-License-Identifier: Apache-2.0
// Which way is up, where it is not said as a direction.
#pragma once

#include <optional>
#include <string>

#include "runtime/scene/scene_description.h"

namespace pointrt {

/// "x", "y", "z", "-x", "-y" or "-z" as a unit vector; nothing for other words.
std::optional<Vec3> axisNamed(const std::string& word);

/// The other way round; "" for what is none of these.
std::string axisName(Vec3 axis);

/// What is up is asked of several in turn: the scene, who asks for its picture, its scans.
struct UprightRequest {
    std::optional<Vec3> known;    ///< by its scans, unit length
    std::optional<Vec3> fallback; ///< where nobody knows; none: what the camera has for up, as sceneUp takes it
};

/// Completes scene.up, puts up what waits for it, and lets cameras that have no up of their own look at the front of
/// what stands on it. Where scans know nothing, cameras stay as they are. Throws Error kBadInput where a sun's north is
/// along up.
void standUpright(SceneDescription& scene, CameraRequest& camera, CameraRequest& staging,
                  const UprightRequest& request);

} // namespace pointrt

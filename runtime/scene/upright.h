// SPDX-License-Identifier: Apache-2.0
// The up direction of a scene, from the scene file, the camera or the scans.
#pragma once

#include <optional>
#include <string>

#include "runtime/scene/scene_description.h"

namespace pointrt {

/// The unit vector of "x", "y", "z", "-x", "-y" or "-z"; none for other words.
std::optional<Vec3> axisNamed(const std::string& word);

/// The name of a unit vector along an axis; "" for other vectors.
std::string axisName(Vec3 axis);

/// The axis, in either direction, that is nearest to a direction; none for the zero vector.
std::optional<Vec3> nearestAxis(Vec3 direction);

/// The sources of the up direction after the scene itself.
struct UpRequest {
    std::optional<Vec3> known;    ///< from the scans, unit length
    std::optional<Vec3> fallback; ///< the default; none: the camera's up, see sceneUp
};

/// Sets scene.up if it is not set, places scene.suns, and makes cameras without an up look at the scene's front. If the
/// scans' up is unknown, cameras stay unchanged. Throws Error kBadInput if a sun's north is along up.
void resolveUp(SceneDescription& scene, CameraRequest& camera, CameraRequest& staging, const UpRequest& request);

} // namespace pointrt

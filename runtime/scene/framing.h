// SPDX-License-Identifier: Apache-2.0
// A camera for a scene, from what was said of it and what there is to see.
#pragma once

#include "runtime/scene/fit.h"
#include "runtime/scene/render_settings.h"
#include "runtime/scene/scene_sample.h"

namespace pointrt {

struct FramedRequest {
    CameraRequest camera;      ///< what frameCamera completes
    std::optional<Vec3> pivot; ///< what it was framed for: the middle of what it shows; none: it was not framed
    double aside = 0;          ///< how far left of the picture's middle that is, in heights of the picture
    bool within = false;       ///< the eye stands where a scanner or a visitor did: lamps outside would not reach
};

/// Completes request where it says neither eye nor target: looks from the side it names, or else from the side that
/// shows most, and so near that all but strays fill the free part of the picture. A target is looked at from the side
/// that is named with it. Left as it is where it says where to look; so are cameras of furnished scenes that name no
/// side, which might end up behind a wall.
/// up: of the scene, unit length; free_fov: a scanner's place may ask for another field of view than request has.
/// Throws Error kBadUsage where a scanner's view is asked for and no scanner's place is known.
FramedRequest frameScene(const CameraRequest& request, const SceneSample& sample, Vec3 up, const PictureArea& area,
                         bool free_fov);

} // namespace pointrt

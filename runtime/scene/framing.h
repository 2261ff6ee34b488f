// SPDX-License-Identifier: Apache-2.0
// Frames a scene: completes a camera request so that the scene fills the picture.
#pragma once

#include "runtime/scene/default_view.h"
#include "runtime/scene/fit.h"
#include "runtime/scene/render_settings.h"
#include "runtime/scene/scene_sample.h"
#include "runtime/scene/visibility.h"

namespace pointrt {

struct FramedRequest {
    CameraRequest camera;      ///< to be completed by frameCamera
    std::optional<Vec3> pivot; ///< the centre of the scene as shown; none: the camera was not framed
    double aside = 0;          ///< distance of the pivot to the left of the picture's centre, in picture heights
    bool within = false;       ///< the eye is inside the scene, where light from outside would be occluded
    std::optional<Surrounding> walls = {}; ///< the walls around the eye, if they enclose it
};

/// Completes a request without eye and target: from its standard view, else from the side that shows most, at the
/// distance at which all but strays fill the free part of the picture. A standard view also applies to a given target.
/// Requests with an eye keep their camera, and the walls around the eye are found. Requests without a standard view
/// also stay unchanged in scenes with shapes, where the eye might end up behind a wall. up: of the scene, unit length;
/// free_fov: a view from a scanner may change the field of view. Throws Error kBadUsage for a scanner's view if no
/// scanner's position is known.
FramedRequest frameScene(const CameraRequest& request, const SceneSample& sample, Vec3 up, const PictureArea& area,
                         bool free_fov);

/// placeKind for a sample with strays.
PlaceKind kindOfPlace(const SceneSample& sample, Vec3 up, bool is_surveyed);

} // namespace pointrt

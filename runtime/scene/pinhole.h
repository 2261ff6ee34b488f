// SPDX-License-Identifier: Apache-2.0
// Cameras as machines have them: intrinsics in pixels and a pose, in place of a target and a field of view.
#pragma once

#include "runtime/scene/render_settings.h"
#include "runtime/util/pixel_size.h"
#include "runtime/util/vec.h"

namespace pointrt {

/// In pixels: focal lengths across and down, and the principal point. The top left pixel's centre is at (0.5, 0.5), its
/// outer corner at (0, 0), as OpenCV's users, COLMAP and nerfstudio have it.
struct PinholeLens {
    double fx = 0, fy = 0, cx = 0, cy = 0;
    bool operator==(const PinholeLens&) const = default;
};

/// world_from_camera: the camera's axes, as OpenCV and COLMAP turn them, and where it stands.
struct CameraPose {
    Vec3 right{1, 0, 0}, down{0, 1, 0}, forward{0, 0, 1}, eye;
    bool operator==(const CameraPose&) const = default;
};

/// The camera whose ray through a place (x, y) of the picture goes along
/// forward + (x - cx) / fx right + (y - cy) / fy down. The pose's axes need be those of a rotation to a thousandth
/// only, as float and text leave them; the result's are. Throws std::invalid_argument with the reason where they are
/// not, where numbers are not finite, a focal length is not above 0, or the picture shows less than 0.001 or nearly 180
/// degrees.
Camera pinholeCamera(const CameraPose& pose, const PinholeLens& lens, PixelSize size);

} // namespace pointrt

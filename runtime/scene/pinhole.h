// SPDX-License-Identifier: Apache-2.0
// Calibrated pinhole cameras: intrinsics in pixels and a pose.
#pragma once

#include "runtime/scene/render_settings.h"
#include "runtime/util/pixel_size.h"
#include "runtime/util/vec.h"

namespace pointrt {

/// Intrinsics in pixels: horizontal and vertical focal length, and the principal point. The centre of the top left
/// pixel is at (0.5, 0.5), as in COLMAP and nerfstudio.
struct PinholeLens {
    double fx = 0, fy = 0, cx = 0, cy = 0;
    bool operator==(const PinholeLens&) const = default;
};

/// world_from_camera: the camera's axes in the convention of OpenCV and COLMAP, and its position.
struct CameraPose {
    Vec3 right{1, 0, 0}, down{0, 1, 0}, forward{0, 0, 1}, eye;
    bool operator==(const CameraPose&) const = default;
};

/// The camera whose ray through the point (x, y) of the picture has the direction
/// forward + (x - cx) / fx right + (y - cy) / fy down. The pose's axes may deviate from a rotation by a thousandth, for
/// rounding; they are orthonormalized. Throws std::invalid_argument with the reason if they deviate more, if a number
/// is not finite, a focal length is not positive, or the field of view is below 0.001 or near 180 degrees.
Camera pinholeCamera(const CameraPose& pose, const PinholeLens& lens, PixelSize size);

} // namespace pointrt

// SPDX-License-Identifier: Apache-2.0
#include "runtime/scene/pinhole.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <stdexcept>

namespace pointrt {
namespace {

/// Rounding error of rotations in files with three decimals.
constexpr double kRotationError = 1e-3;
/// Tangents of half the fields of view that --fov allows, 0.001 and 179.999 degrees.
constexpr double kMinTangent = 8.7e-6, kMaxTangent = 1.14e5;

bool isFinite(Vec3 v) { return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z); }

void require(bool holds, const char* reason) {
    if (!holds) throw std::invalid_argument(reason);
}

void requireRotation(const CameraPose& pose) {
    const Vec3 axes[] = {pose.right, pose.down, pose.forward};
    for (int a = 0; a < 3; ++a) {
        const double off = std::max(std::abs(length(axes[a]) - 1), std::abs(dot(axes[a], axes[(a + 1) % 3])));
        require(off <= kRotationError, "its axes are not orthonormal");
    }
    require(dot(cross(pose.right, pose.down), pose.forward) > 0, "its axes are mirrored");
}

void requireLens(const PinholeLens& lens, PixelSize size) {
    require(lens.fx > 0 && lens.fy > 0 && std::isfinite(lens.fx) && std::isfinite(lens.fy),
            "its focal lengths are not positive");
    require(std::isfinite(lens.cx) && std::isfinite(lens.cy), "its principal point is not finite");
    const double across = std::max(std::abs(lens.cx), std::abs(size.width - lens.cx)) / lens.fx;
    const double down = std::max(std::abs(lens.cy), std::abs(size.height - lens.cy)) / lens.fy;
    require(std::min(size.width / lens.fx, size.height / lens.fy) / 2 >= kMinTangent,
            "its field of view is below 0.001 degrees");
    require(std::max(across, down) <= kMaxTangent, "its field of view exceeds 89.9995 degrees to one side");
}

} // namespace

Camera pinholeCamera(const CameraPose& pose, const PinholeLens& lens, PixelSize size) {
    require(isFinite(pose.right) && isFinite(pose.down) && isFinite(pose.forward) && isFinite(pose.eye),
            "its pose is not finite");
    requireRotation(pose);
    requireLens(lens, size);
    const Vec3 forward = normalize(pose.forward);
    const Vec3 right = normalize(pose.right - dot(pose.right, forward) * forward);
    const Vec3 up = cross(right, forward);
    const double half_height = size.height / (2 * lens.fy);
    Camera camera;
    camera.eye = pose.eye;
    camera.fov_deg = 2 * std::atan(half_height) * 180 / std::numbers::pi;
    camera.up = up;
    // pixels are square only if fx equals fy, and the principal point may be off the picture's centre
    camera.right = lens.fy / lens.fx * right;
    camera.forward =
        forward + (size.width / 2.0 - lens.cx) / lens.fx * right + (lens.cy - size.height / 2.0) / lens.fy * up;
    return camera;
}

} // namespace pointrt

// SPDX-License-Identifier: Apache-2.0
#include "tests/bench/quality/raw/camera.h"

#include <cmath>
#include <numbers>

namespace pointrt::quality {

PinholeRays::PinholeRays(const Pinhole& camera)
    : forward_((camera.target - camera.eye).normalized()), right_(forward_.cross(camera.up).normalized()),
      up_(right_.cross(forward_)), half_(std::tan(camera.fov_deg / 2 * std::numbers::pi / 180)), size_(camera.size) {}

Eigen::Vector3d PinholeRays::direction(int row, int column) const {
    const double x = (2 * (column + 0.5) / size_ - 1) * half_, y = (1 - 2 * (row + 0.5) / size_) * half_;
    return (forward_ + x * right_ + y * up_).normalized();
}

} // namespace pointrt::quality

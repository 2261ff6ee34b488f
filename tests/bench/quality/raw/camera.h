// SPDX-License-Identifier: Apache-2.0
// The camera of pictures and truth: a pinhole with rays through pixel centres, as in
// shaders/lib/camera_ray.glsl.
#pragma once

#include <Eigen/Geometry>

namespace pointrt::quality {

/// Square pictures; input units.
struct Pinhole {
    Eigen::Vector3d eye, target, up;
    double fov_deg = 30; ///< horizontal and vertical, above 0 and below 180
    int size = 1024;     ///< pixels per row and column, at least 1

    std::size_t pixels() const { return static_cast<std::size_t>(size) * static_cast<std::size_t>(size); }
};

/// Ray directions of a pinhole camera.
class PinholeRays {
public:
    explicit PinholeRays(const Pinhole& camera);
    /// Unit direction through the centre of a pixel; rows go down.
    Eigen::Vector3d direction(int row, int column) const;

private:
    Eigen::Vector3d forward_, right_, up_;
    double half_, size_;
};

} // namespace pointrt::quality

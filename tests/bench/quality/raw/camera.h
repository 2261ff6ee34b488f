// SPDX-License-Identifier: Apache-2.0
// The camera that pictures and truth share: a pinhole, rays through the middles of pixels as
// shaders/lib/camera_ray.glsl makes them.
#pragma once

#include <Eigen/Geometry>

namespace pointrt::quality {

/// Square pictures; input units.
struct Pinhole {
    Eigen::Vector3d eye, target, up;
    double fov_deg = 30; ///< of a row and a column alike, above 0 and below 180
    int size = 1024;     ///< pixels a row and a column, at least 1

    std::size_t pixels() const { return static_cast<std::size_t>(size) * static_cast<std::size_t>(size); }
};

/// A pinhole's directions.
class PinholeRays {
public:
    explicit PinholeRays(const Pinhole& camera);
    /// Unit length, through the middle of a pixel, rows downwards.
    Eigen::Vector3d direction(int row, int column) const;

private:
    Eigen::Vector3d forward_, right_, up_;
    double half_, size_;
};

} // namespace pointrt::quality

// SPDX-License-Identifier: Apache-2.0
// The camera of pointrt-view, in double precision and written anew from its documentation.
#pragma once

#include <cstdint>

#include "tests/gaussians/oracle.h"

namespace pointrt::test {

/// A pinhole camera; right, up and forward are orthonormal. Pixels: x right, y down, centres at 0.5.
struct OracleCamera {
    Double3 eye{}, right{}, up{}, forward{};
    double tan_half_fov = 1; ///< of half the vertical field of view
    std::uint32_t width = 512, height = 512;
};

struct OracleView {
    Double3 eye{0, 0, 4}, target{}, up{0, 1, 0};
    double fov_deg = 40; ///< vertical
};

/// Throws std::invalid_argument if target is the eye, up is along the view, or the field of view is not in (0, 180).
OracleCamera lookAt(const OracleView& view, std::uint32_t width, std::uint32_t height);

/// The ray through a position of the picture.
OracleRay rayThrough(const OracleCamera& camera, double x, double y);

/// The place of a sample in its pixel, 0 to 1 from the upper left corner, if there are several samples: a sequence that
/// a hash of the pixel shifts (shaders/lib/camera_ray.glsl). A picture of one sample takes the centre.
struct PixelOffset {
    double x = 0.5, y = 0.5;
};
PixelOffset sampleOffset(std::uint32_t pixel, std::uint32_t sample, std::uint32_t seed);

} // namespace pointrt::test

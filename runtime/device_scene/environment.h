// SPDX-License-Identifier: Apache-2.0
// Environment lighting from an equirectangular image: texels and sampling distributions for
// shaders/shade/environment.glsl.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "runtime/image/image_read.h"
#include "runtime/util/vec.h"
#include "shaders/shared/environment_layout.h"

namespace pointrt {

/// Flat arrays, ready for texel buffers of RGBA32F and R32F. At most 4096 x 4096 texels.
struct Environment {
    std::uint32_t width = 0, height = 0; ///< of the image
    std::uint32_t columns = 0, rows = 0; ///< of the sampling grid, at most 512 x 256
    std::vector<float> texels;           ///< 4 per texel, row-major; the fourth is 1
    std::vector<float> cdf; ///< rows + 1 values for the rows, then columns + 1 for each row; each ascends from 0 to 1
    std::array<double, 3> mean_radiance{}; ///< over all directions
};

/// Downsamples images of more than 4096 pixels a side. The density of a cell is the luminance that environmentRadiance
/// returns, integrated over the cell's solid angle. It is 0 only where the image is black, or where a cell has less
/// than 2^-24 of its row's light. A black image is sampled uniformly.
/// @param image not empty
Environment makeEnvironment(FloatImage image);

/// The shader parameters besides the arrays.
/// @param map_from_world rows of a rotation to the map space of shaders/shared/environment_layout.h
/// @param strength multiplies all radiance
gpu::EnvironmentFrame environmentFrame(const Environment& environment, const std::array<Vec3, 3>& map_from_world,
                                       float strength);

/// The rotation to map space, with up (unit length) as the zenith and the image rotated by rotation_deg about it,
/// counter-clockwise as seen from above. Without rotation the middle column is towards -z if up is y, and towards +y if
/// up is z.
std::array<Vec3, 3> mapFromWorld(Vec3 up, double rotation_deg);

} // namespace pointrt

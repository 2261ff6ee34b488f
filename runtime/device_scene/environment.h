// SPDX-License-Identifier: Apache-2.0
// An equirectangular image as light from all around: texels and distributions for shaders/shade/environment.glsl.
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
    std::vector<float> texels;           ///< 4 a texel, row by row; the last is 1
    std::vector<float> cdf; ///< rows + 1 words for the rows, then columns + 1 for each row; each from 0 to 1
    std::array<double, 3> mean_radiance{}; ///< over all directions
};

/// Averages a image larger than 4096 a side down to that. The density of a cell is the integral over its solid angle
/// of the luminance that environmentRadiance gives there, so it is 0 only where the image is black, or where a cell
/// has less than 2^-24 of its row's light. A black image is sampled evenly. image must not be empty.
Environment makeEnvironment(FloatImage image);

/// What the shaders take beside the arrays. map_from_world: rows of a rotation into the map space of
/// shaders/shared/environment_layout.h; strength multiplies all radiance.
gpu::EnvironmentFrame environmentFrame(const Environment& environment, const std::array<Vec3, 3>& map_from_world,
                                       float strength);

/// The rotation into map space where up (unit) is the zenith and the image is turned by rotation_deg about it,
/// counter-clockwise as seen from above. Without rotation the middle column looks along -z where up is y, and along +y
/// where up is z.
std::array<Vec3, 3> mapFromWorld(Vec3 up, double rotation_deg);

} // namespace pointrt

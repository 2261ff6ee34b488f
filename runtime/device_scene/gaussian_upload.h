// SPDX-License-Identifier: Apache-2.0
// The Gaussians of a .pro on the device, in the buffers of a scan (shaders/shared/gaussian_layout.h).
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "pointrt/pro.h"
#include "shaders/shared/gaussian_layout.h"

namespace pointrt {

/// A box in cube units.
struct CubeBox {
    std::array<double, 3> low{}, high{};
};

/// The cube that rows and nodes refer to, in units of the file's cube.
struct TracedCube {
    std::array<double, 3> low{};
    double edge = 1;
};

/// The contents of the buffers.
struct GaussianBuffers {
    std::vector<gpu::GaussianRows> rows; ///< in the order of the file
    std::vector<gpu::GaussianNode> nodes;
    std::vector<std::uint32_t> lists;
    std::vector<std::uint32_t> harmonics; ///< HARMONIC_TEXELS words of 4 per Gaussian
    CubeBox box;                          ///< around all Gaussians that are not too faint; may extend beyond the cube
    TracedCube cube;
    bool reaches_out = false; ///< whether some of these Gaussians extend beyond the cube
};

/// Decodes the sections of a file.
/// @param splats SPLT of the file
GaussianBuffers decodeGaussians(const pro_gaussians& gaussians, const std::uint32_t* splats, std::uint32_t count);

} // namespace pointrt

// SPDX-License-Identifier: Apache-2.0
// Pictures by the oracle.
#pragma once

#include <cstdint>
#include <vector>

#include "tests/gaussians/oracle_camera.h"

namespace pointrt::test {

struct PictureOptions {
    Double3 background{}; ///< display-encoded
    double stop_below = kOracleStop;
    std::uint32_t spp = 1; ///< samples per pixel; with several, linear light is averaged, as pointrt-view does
    std::uint32_t seed = 0;
    bool culls = true; ///< false: every ray tests every Gaussian
};

/// Row-major pixels, y down.
struct OraclePicture {
    std::uint32_t width = 0, height = 0;
    std::vector<Double3> colors;          ///< display-encoded, over the background
    std::vector<OracleComposite> centers; ///< along the rays through the centres of pixels
};

OraclePicture renderPicture(const OracleScene& scene, const OracleCamera& camera, const PictureOptions& options = {});

} // namespace pointrt::test

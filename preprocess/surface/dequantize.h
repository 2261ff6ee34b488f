// SPDX-License-Identifier: GPL-3.0-or-later
// Removes depth quantisation: depth cameras measure in steps, which look like terraces on walls and floors.
#pragma once

#include <cstdint>
#include <vector>

#include "preprocess/cloud/cloud.h"

namespace pointrt {

struct DequantizeReport {
    struct OfScan {
        std::uint32_t scan = 0;        ///< index in Cloud::scans
        double noise_over_spacing = 0; ///< median, before
    };
    std::vector<OfScan> scans; ///< those with quantised depths
    std::size_t moved = 0;     ///< points
};

/// Detects grids with quantised depths, by the depths alone, and moves their points along the line of sight onto planes
/// fitted to windows that are as large as possible: the residual must not exceed the noise, and windows end at jumps of
/// more than a few steps. No point moves further than a step or, if that is more, three standard deviations of the
/// scan's noise. Sets Cloud::noise of those points: that of the quantisation, or the measured noise if larger. Leaves
/// all other grids, and those with noise below kCleanNoise, bit for bit.
DequantizeReport dequantizeDepths(Cloud& cloud);

} // namespace pointrt

// SPDX-License-Identifier: GPL-3.0-or-later
// Depth cameras: their depths come in steps, which show as terraces on walls and floors.
#pragma once

#include <cstdint>
#include <vector>

#include "preprocess/cloud/cloud.h"

namespace pointrt {

struct LevelReport {
    struct OfScan {
        std::uint32_t scan = 0;        ///< number in Cloud::scans
        double noise_over_spacing = 0; ///< medians, before
    };
    std::vector<OfScan> scans; ///< whose depths come in steps
    std::size_t moved = 0;     ///< points
};

/// Finds the grids whose depths come in steps, by the depths alone, and moves their points along the sight onto planes
/// through as many neighbours as these fit: a plane's residual must be that of the noise, its window ends at jumps of
/// more than some steps, and nothing moves further than a step, or three standard deviations of the scan's noise where
/// that is more. Fills Cloud::noise for those points: the step's, or the measured one where that is larger. Grids
/// without steps, and such whose noise is below kCleanNoise, stay as they are to the bit.
LevelReport levelSteps(Cloud& cloud);

} // namespace pointrt

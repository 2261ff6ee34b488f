// SPDX-License-Identifier: Apache-2.0
// What a receiver makes of the rays of one beam.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

namespace pointrt {

/// Where one ray of a beam was sent back.
struct LidarTouch {
    double range = 0;
    double power = 0;
    float cosine = 0; ///< of the incidence
    std::uint32_t splat = 0, instance = 0, tile = 0;
};

struct LidarReturn {
    double range = 0;     ///< mean of its touches, weighted by power
    double power = 0;     ///< sum of theirs
    LidarTouch strongest; ///< of them; the nearest of equal ones
};

/// Sorts touches by range and parts them where the next one is more than resolution away. The result is in place of
/// what was in returns, nearest first.
void findReturns(std::span<LidarTouch> touches, double resolution, std::vector<LidarReturn>& returns);

} // namespace pointrt

// SPDX-License-Identifier: Apache-2.0
// From the echoes of a beam's rays to its returns.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

namespace pointrt {

/// The reflection of one ray of a beam.
struct RayEcho {
    double range = 0;
    double power = 0;
    float cosine = 0; ///< cosine of the angle of incidence
    std::uint32_t splat = 0, instance = 0, tile = 0;
};

struct LidarReturn {
    double range = 0;  ///< mean of its echoes, weighted by power
    double power = 0;  ///< sum over its echoes
    RayEcho strongest; ///< the strongest echo; the nearest if several are equal
};

/// Sorts echoes by range and starts a new return at each gap wider than resolution. Overwrites returns, nearest first.
void findReturns(std::span<RayEcho> echoes, double resolution, std::vector<LidarReturn>& returns);

} // namespace pointrt

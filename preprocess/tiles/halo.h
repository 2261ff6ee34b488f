// SPDX-License-Identifier: GPL-3.0-or-later
// How many of its neighbours' points a tile's own need around them.
#pragma once

#include <vector>

#include "preprocess/cloud/cloud.h"
#include "preprocess/tiles/plan.h"

namespace pointrt {

/// The points around a tile's core that have been read.
struct Halo {
    double width = 0; ///< input units
    /// Its rim, relative to the core's corner. Infinitely far on sides behind which the plan has no points.
    Vec3d low, high;

    /// Whether there are points of the plan outside.
    bool leavesPointsOut() const { return low.array().isFinite().any() || high.array().isFinite().any(); }
};

Halo haloOf(const SetPlan& plan, const PlanTile& tile, double width);

/// How many points of the core lack neighbours, as their k-th one is more than half as far away as the halo's rim: then
/// its own neighbours, which have a say as well, may lie behind it. A single point or a few, far from all others, are
/// strays whatever lies there, and do not count.
/// @param core [points]
std::size_t countLacking(const std::vector<Vec3f>& positions, const std::vector<std::uint8_t>& core, const Halo& halo,
                         std::size_t k);

} // namespace pointrt

// SPDX-License-Identifier: GPL-3.0-or-later
// Width of a tile's halo: the neighbouring points that the surface of its core needs.
#pragma once

#include <vector>

#include "preprocess/cloud/cloud.h"
#include "preprocess/tiles/plan.h"

namespace pointrt {

/// The halo that was read around a tile's core.
struct Halo {
    double width = 0; ///< input units
    /// Its faces, relative to the core's corner; infinite on sides beyond which the plan has no points.
    Vec3d low, high;

    /// Whether the plan has points outside the halo.
    bool leavesPointsOut() const { return low.array().isFinite().any() || high.array().isFinite().any(); }
};

Halo haloOf(const SetPlan& plan, const PlanTile& tile, double width);

/// Counts points of the core that may lack neighbours: their k-th neighbour is more than half as far away as the halo's
/// rim, so that its own neighbours, which matter as well, may lie outside. Does not count single points or a few far
/// from all others: they are strays in any case.
/// @param core [points]
std::size_t countLacking(const std::vector<Vec3f>& positions, const std::vector<std::uint8_t>& core, const Halo& halo,
                         std::size_t k);

} // namespace pointrt

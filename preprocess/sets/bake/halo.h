// SPDX-License-Identifier: GPL-3.0-or-later
// How many of its neighbours' points a tile's own need around them.
#pragma once

#include <vector>

#include "preprocess/cloud/cloud.h"
#include "preprocess/sets/plan.h"

namespace pointrt {

/// Width of a halo to begin with, in spacings of the tile's points. Neighbours of neighbours have a say five times over
/// until a point has its normal (normals.cpp); with 16 of them, which reach 2.3 spacings on a surface, that is 11.5,
/// and half as much is left for where points lie less evenly.
constexpr double kHaloSpacings = 16;

/// Whether the halo is too narrow: a point of the core has fewer than k neighbours nearer than the halo's rim, and is
/// not alone in that. A single point or a few, far from all others, are strays whatever lies behind the rim.
/// @param core [points]
/// @param low, high the halo's box, in the cloud's own coordinates
bool isHaloTooNarrow(const std::vector<Vec3f>& positions, const std::vector<std::uint8_t>& core, const Vec3d& low,
                     const Vec3d& high, double halo, std::size_t k);

} // namespace pointrt

// SPDX-License-Identifier: GPL-3.0-or-later
// Noisy points moved onto the surface among them.
#pragma once

#include "preprocess/surface/neighbors.h"

namespace pointrt::surface {

struct ProjectionReport {
    std::size_t moved = 0;
    std::vector<float> sigma;       ///< [points], standard deviation across the surface that is left
    std::vector<float> support;     ///< [points], share of the surroundings on the surface; 0 of those that stayed
    std::vector<std::uint8_t> lost; ///< [points], 1: its normal before and after say that it is on no surface
};

/// Moves each point onto the algebraic point set surface of its surroundings (G. Guennebaud and M. Gross, Algebraic
/// Point Set Surfaces, SIGGRAPH 2007), with weights that grow robust step by step, and gives it the normal of a quadric
/// there. Points of the other side of a thin sheet have no say, nobody moves further than 8 sigma, and points with a
/// sigma of 0 stay as they are.
/// @param sigma [points], standard deviation across the surface
/// @param search over the points as they are
/// Needs normals that tell the sides. The result does not depend on the number of threads.
ProjectionReport projectPoints(Points& points, const NeighborLists& lists, const NearestSearch& search,
                               const std::vector<float>& sigma, float strength, const StageShare& share);

} // namespace pointrt::surface

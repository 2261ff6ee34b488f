// SPDX-License-Identifier: GPL-3.0-or-later
// Projects noisy points onto the surface among them.
#pragma once

#include "preprocess/surface/point_graph.h"

namespace pointrt::surface {

struct ProjectionReport {
    std::size_t moved = 0;
    std::vector<std::uint8_t> off_surface; ///< [points], 1: sphere and quadric disagree on the normal
};

/// Moves each point onto the algebraic point set surface of its neighbourhood (G. Guennebaud and M. Gross, Algebraic
/// Point Set Surfaces, SIGGRAPH 2007), with weights that get more robust step by step, and gives it the normal of a
/// quadric there. Neighbours on the other side of a thin sheet do not count. No point moves further than 8 sigma;
/// points with noise 0 stay.
/// Before: points.noise is the standard deviation across the surface. After: points.noise is the standard deviation
/// that remains, and points.support the share of the neighbourhood on the surface, 0 for points that stayed. The graph
/// must be connected again: graph.search is empty, and graph.lists belong to the old positions. Needs oriented normals.
/// The result does not depend on the number of threads.
ProjectionReport projectPoints(PointGraph& graph, float strength, const StageShare& share);

} // namespace pointrt::surface

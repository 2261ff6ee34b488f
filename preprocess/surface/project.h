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
/// Point Set Surfaces, SIGGRAPH 2007), and gives it the normal of a quadric there. Each sphere is fitted twice, with
/// robust weights: by the distance from the tangent plane, then, narrower, by the distance from the first sphere.
/// Neighbours that face the other way, on the other side of a thin sheet, do not count. No point moves further than 8
/// sigma. Points without noise stay, and so do points scattered in space.
/// Before: points.noise is the standard deviation across the surface. After: points.noise is the standard deviation
/// that remains, and points.support the share of the neighbourhood on the surface, averaged over neighbours; 0 for
/// points that stayed. The graph must be connected again: graph.search is empty, and graph.lists belong to the old
/// positions. Needs oriented normals. The result does not depend on the number of threads.
ProjectionReport projectPoints(PointGraph& graph, float strength, const StageShare& share);

} // namespace pointrt::surface

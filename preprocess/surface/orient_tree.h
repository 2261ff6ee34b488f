// SPDX-License-Identifier: GPL-3.0-or-later
// Orientation along a minimum spanning tree over neighbours, edge weight 1 - |n_i . n_j|: H. Hoppe et al.,
// Surface Reconstruction from Unorganized Points, SIGGRAPH 1992. Two ways to the same tree.
#pragma once

#include <cstdint>
#include <vector>

#include "preprocess/neighbors/neighbors.h"

namespace pointrt::surface {

/// Flips normals so that they agree along the tree, starting from the points flagged in sources, which stay.
/// Every component of the graph of lists must hold a source.
/// By CGAL's mst_orient_normals, which finds its own k neighbours: 7 to 13 us and 1.5 KB a point, on one core.
void orientByCgal(Points& points, const NeighborLists& lists, const std::vector<std::uint8_t>& sources);

/// The same over lists as they are, by Kruskal's algorithm: about 1 us and 60 bytes a point.
void orientByKruskal(Points& points, const NeighborLists& lists, const std::vector<std::uint8_t>& sources);

} // namespace pointrt::surface

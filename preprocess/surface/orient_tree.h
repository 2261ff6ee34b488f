// SPDX-License-Identifier: GPL-3.0-or-later
// Orientation along a minimum spanning tree over neighbours, edge weight 1 - |n_i . n_j|: H. Hoppe et al.,
// Surface Reconstruction from Unorganized Points, SIGGRAPH 1992. Two ways to the same tree.
#pragma once

#include <cstdint>
#include <vector>

#include "preprocess/surface/neighbors.h"

namespace pointrt::surface {

/// How two neighbours' normals are to be turned against each other, and how sure that is.
struct Agreement {
    float sure = 0;        ///< 0 to 1
    bool opposite = false; ///< as the normals now are, one of them is on the wrong side
    bool sheets = false;   ///< the normals are alike, and yet the points lie behind each other, on two sheets
};

/// By the mirror in the plane half way between the points, which takes one normal to the other where they lie on a
/// circle or back to back (H. Xie et al., Piecewise C1 Continuous Surface Reconstruction of Noisy Point Clouds via
/// Local Implicit Quadric Regression, VIS 2003). Where the edge is not aslant that is the same as the normals' cosine,
/// but for rounding.
Agreement agreementOf(const Points& points, std::size_t a, std::size_t b);

/// What the neighbours' edges are like, point by point.
struct EdgeKinds {
    std::vector<std::uint8_t> aslant; ///< [points], 1: an edge leaves the surface, so that normals alone do not tell
    bool sheets = false;              ///< edges run between sheets
};
EdgeKinds edgeKinds(const Points& points, const NeighborLists& lists);

/// Flips normals so that they agree along the tree, starting from the points flagged in sources, which stay.
/// Every component of the graph of lists must hold a source.
/// By CGAL's mst_orient_normals, which finds its own k neighbours: 7 to 13 us and 1.5 KB a point, on one core.
void orientByCgal(Points& points, const NeighborLists& lists, const std::vector<std::uint8_t>& sources);

/// The same over lists as they are, by Kruskal's algorithm: about 1 us and 60 bytes a point.
void orientByKruskal(Points& points, const NeighborLists& lists, const EdgeKinds& kinds,
                     const std::vector<std::uint8_t>& sources);

} // namespace pointrt::surface

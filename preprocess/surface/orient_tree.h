// SPDX-License-Identifier: GPL-3.0-or-later
// Orients normals along a minimum spanning tree over neighbours with edge weights 1 - |n_i . n_j|: H. Hoppe et al.,
// Surface Reconstruction from Unorganized Points, SIGGRAPH 1992. Two algorithms for the same tree.
#pragma once

#include <cstdint>
#include <vector>

#include "preprocess/surface/neighbors.h"

namespace pointrt::surface {

/// Whether two neighbours' normals are on the same side, and how sure that is.
struct Agreement {
    float sure = 0;        ///< 0 to 1
    bool opposite = false; ///< one of the normals, as they are now, is on the wrong side
    bool sheets = false;   ///< the points are on two sheets: similar normals, but one point is behind the other
};

/// Compares one normal with the other's reflection in the bisecting plane of the points, which is the same for points
/// on a circle or back to back (H. Xie et al., Piecewise C1 Continuous Surface Reconstruction of Noisy Point Clouds via
/// Local Implicit Quadric Regression, VIS 2003). If the edge is not oblique, that equals the normals' cosine up to
/// rounding.
Agreement agreementOf(const PointSet& points, std::size_t a, std::size_t b);

/// Properties of the edges between neighbours.
struct EdgeKinds {
    std::vector<std::uint8_t> oblique; ///< [points], 1: an edge leaves the surface, so that normals alone do not decide
    bool sheets = false;               ///< some edges join two sheets
};
EdgeKinds edgeKinds(const PointSet& points, const NeighborLists& lists);

/// Flips normals so that they agree along the tree, starting from the points flagged in sources, which stay. Every
/// component of the graph must hold a source. Uses CGAL's mst_orient_normals, which finds its own k neighbours and
/// takes 7 to 13 us and 1.5 KB per point, on one core.
void orientByCgal(PointSet& points, const NeighborLists& lists, const std::vector<std::uint8_t>& sources);

/// The same over the given lists, by Kruskal's algorithm: about 1 us and 60 bytes per point.
void orientByKruskal(PointSet& points, const NeighborLists& lists, const EdgeKinds& kinds,
                     const std::vector<std::uint8_t>& sources);

} // namespace pointrt::surface

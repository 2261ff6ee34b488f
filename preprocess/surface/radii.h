// SPDX-License-Identifier: GPL-3.0-or-later
// Disc radii: the smallest that close the surface.
#pragma once

#include <optional>
#include <vector>

#include "preprocess/surface/point_graph.h"

namespace pointrt::surface {

/// Sets points.radii, > 0 and finite: the distance to the farthest corner of the point's Voronoi cell in the tangent
/// plane, so that all discs together cover that plane, times an overlap of 1.4, or at least 1.2 if the disc would stick
/// out of a ridge or over an open border. Corners further away than gaps of the sampling can be (at an open border, of
/// a lone point), or with nothing behind them, do not count. Discs of points scattered in space (planarity) are half as
/// wide as the distance to the second neighbour.
/// @param oriented normals distinguish the two sides of a thin sheet
void computeRadii(PointGraph& graph, bool oriented, const StageShare& share);

/// Shrinks discs of smoothed points (noise above 0): smoothing moved such points from behind one another into one
/// surface, which therefore has more points than their spacing suggests.
void shrinkSmoothed(PointSet& points);

/// Shrinks discs much wider than those around them if their neighbours are in no plane: in crowns and hedges, at edges
/// and among outliers they look like plates between closely sampled parts. Does the same to discs much wider than the
/// distances between neighbours that are in no plane, and to those of sparse points, unless neighbours in a plane
/// surround them.
/// @param sparse_reach a point is sparse if the farthest of its nearest neighbours is further away than this, in the
/// unit of the points
/// @param decided_limit limit of radii decided for a larger cloud; discs far below it need less support
void shrinkPlates(PointGraph& graph, float sparse_reach, std::optional<float> decided_limit);

/// Shrinks the few radii far above all others. Isolated points are each other's neighbours, and no local rule
/// distinguishes their spacing from that of a surface: their discs would be sails in the picture.
/// @param decided limit decided for a larger cloud
void limitRadii(std::vector<float>& radii, std::optional<float> decided);

/// The limit of a cloud's radii: `times` the radius at `place`, counted from the smallest.
struct RadiusLimitRule {
    std::size_t place = 0;
    float times = 1;
};
/// nullopt if there are not enough radii.
std::optional<RadiusLimitRule> radiusLimitRule(std::size_t count);

/// The limit of a cloud's radii; infinity if there are too few. Reorders them.
float radiusLimit(std::vector<float>& radii);

} // namespace pointrt::surface

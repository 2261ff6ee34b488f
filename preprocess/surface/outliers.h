// SPDX-License-Identifier: GPL-3.0-or-later
// Detects outliers: points far off any surface.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "preprocess/surface/neighbors.h"

namespace pointrt::surface {

/// With fewer points, outliers look the same as sparse sampling.
constexpr std::size_t kMinPointsForOutliers = 1000;

/// [points], 1: keep, 0: outlier. Distances are compared with those of neighbours, so that a change of density does not
/// make outliers. Let d be a point's distance to its k-th neighbour. A point is an outlier if
///   - d is more than 4 times the d of most of its neighbours, or
///   - it is in a clump of at most k points that is 20 times its own size away from all others, and 4 times the d of
///     those, or
///   - it is a floater, with other floaters for neighbours: d is more than 4 times the 95% quantile of all points, and
///     neither a plane nor a line fits its neighbours, or
///   - d is more than 1.7 times the d of most of its neighbours, and the point is 4 times as high over their plane as
///     they are.
/// Such a point stays if it lies among the points of a sparse part of a surface, beside a clump or a dense part, except
/// if it is a floater. Keeps all points of clouds of fewer than kMinPointsForOutliers points, and if more than half
/// would go. Neither holds for a part of a larger cloud: floaters go in any case. lists must be of nearest neighbours.
/// @param common_reach commonReach of the larger cloud, if the points are a part of one
std::vector<std::uint8_t> flagInliers(const PointSet& points, const NeighborLists& lists,
                                      std::optional<float> common_reach = {});

/// The 95% quantile of the points' distances to their k-th neighbour (at least one).
float commonReach(std::vector<float> distances);

} // namespace pointrt::surface

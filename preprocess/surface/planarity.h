// SPDX-License-Identifier: GPL-3.0-or-later
// Planarity weights: whether a point lies on a surface, or among points scattered in space.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "preprocess/surface/point_graph.h"

namespace pointrt::surface {

/// With fewer points, 16 neighbours reach round a whole object, and no part of it looks flat.
constexpr std::size_t kMinPointsForPlanarity = 1000;

/// Sets points.planarity: 1 on a surface, an edge or a corner, however noisy, as long as the neighbourhood shows it; 0
/// among points scattered in space, such as foliage and outliers; in between if neither is clear. Clears it if the
/// cloud consists of surfaces (isScattered), or has fewer than kMinPointsForPlanarity points and is not part of a
/// larger one. Judges a neighbourhood's dimension by the eigenvalues of its covariance, at the scale where it is most
/// planar (Pauly et al., Efficient simplification of point-sampled surfaces, 2002; Demantke et al., Dimensionality
/// based scale selection in 3D lidar point clouds, 2011). Needs normals.
/// @param decided for a part of a larger cloud: whether that has scattered points
/// @param inner [points] 1 for those that are counted
/// @return the number of scattered points among those; 0 if decided is false
std::size_t weighPlanarity(PointGraph& graph, std::optional<bool> decided, const std::vector<std::uint8_t>& inner,
                           const StageShare& share);

/// Sets the planarity of points that cleaning moved onto a surface to 1 if they and those around lie in surfaces now:
/// noise as wide as folds had made them look scattered. Needs points.support.
void raisePlanarityOfSmoothed(PointGraph& graph, const StageShare& share);

/// Whether a cloud with this many scattered points contains more than surfaces.
bool isScattered(std::size_t scattered, std::size_t points);

} // namespace pointrt::surface

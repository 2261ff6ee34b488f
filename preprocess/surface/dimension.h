// SPDX-License-Identifier: GPL-3.0-or-later
// Whether a point lies on a surface, or among points scattered in space.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "preprocess/surface/neighbors.h"

namespace pointrt::surface {

/// With fewer points 16 neighbours reach round a whole body, and nothing of it is flat.
constexpr std::size_t kFewForSheets = 1000;

/// How far the surroundings of each point are a surface: 1 a smooth one, an edge or a corner, however noisy, as long as
/// the neighbourhood shows it; 0 points scattered in space, as leaves and strays are; in between neither is clear.
/// Empty where the cloud is one of surfaces (isScattered), or by itself has fewer than kFewForSheets points. The
/// dimension of a neighbourhood by the eigenvalues of its covariance, at the scale where it is most a plane (Pauly et
/// al., Efficient simplification of point-sampled surfaces, 2002; Demantke et al., Dimensionality based scale selection
/// in 3D lidar point clouds, 2011). Points need normals.
/// @param decided for a larger cloud: whether it is none of surfaces
/// @param inner [points] 1 for those that are counted
/// @param scattered how many of those are, by themselves and among their neighbours; 0 where decided is false
std::vector<float> sheetShares(const Points& points, const NeighborLists& lists, std::optional<bool> decided,
                               const std::vector<std::uint8_t>& inner, std::size_t& scattered, const StageShare& share);

/// Whether a cloud with so many scattered points is none of surfaces.
bool isScattered(std::size_t scattered, std::size_t points);

} // namespace pointrt::surface

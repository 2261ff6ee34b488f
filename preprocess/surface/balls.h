// SPDX-License-Identifier: GPL-3.0-or-later
// Balls instead of discs: for clouds that sample no surface, and for single points that are on none.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "preprocess/surface/point_graph.h"

namespace pointrt::surface {

/// Whether a cloud is so sparse that most of its neighbourhoods are not surfaces, as they reach around thin parts.
/// False for clouds of so many points that sparsity alone cannot be the reason.
bool isTooSparse(const PointGraph& graph);

/// Whether a cloud with this many scattered points (weighPlanarity) has hardly any point on a surface.
bool isVolume(std::size_t scattered, std::size_t points);

/// Sets the radii of balls for all points. Half the median distance to the three nearest neighbours makes typical
/// neighbours touch; taking the median of that over the neighbourhood evens them out, but follows the density. Limited
/// to three times the cloud's median, so that strays stay small. Given radii are kept.
void setBallRadii(PointGraph& graph, const StageShare& share);

/// Whether points may become balls by themselves: not if so few are on no surface that the cloud consists of surfaces,
/// nor if the cloud is so small that only its sparsity could show it.
/// @param decided for a part of a larger cloud: whether that has scattered points
bool mayHaveBalls(const PointSet& points, std::optional<bool> decided);

/// [points] 1: the point is on no surface, and becomes a ball. Points with given radii are pieces of a surface.
std::vector<std::uint8_t> flagBalls(const PointSet& points);

/// Gives balls the radius that shows as much as their discs did.
void shrinkBalls(PointSet& points, const std::vector<std::uint8_t>& balls);

} // namespace pointrt::surface

// SPDX-License-Identifier: GPL-3.0-or-later
// Strays far off any surface.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "preprocess/surface/neighbors.h"

namespace pointrt::surface {

/// Fewer points are too few to tell a stray from sparse sampling.
constexpr std::size_t kFewForStrays = 1000;

/// Flags the points to keep: 0 marks a stray. Measures are relative to the neighbours, so that a change of density is
/// no reason to go. A point is a stray when
///   - it reaches its k-th neighbour only at 4 times the distance within which most of its neighbours reach theirs, or
///   - it is in a clump of at most k points that is 20 times its own size away from all others, and 4 times the
///     distance at which those reach their k-th neighbour, or
///   - it reaches its k-th neighbour only at 4 times the distance within which 95 % of all points reach theirs, and
///     neither a plane nor a line fits its neighbours: floaters, each other's neighbours, or
///   - it reaches its k-th neighbour only at 1.7 times the distance within which most of its neighbours reach theirs,
///     and stands four times as high over their plane as they do.
/// Everything stays in clouds of fewer than kFewForStrays points, and where more than half would go; in a part of a
/// larger cloud its size does not matter, and floaters go in any case. lists are of nearest neighbours.
/// @param common_reach commonReach of a larger cloud that the points are a part of; none: they are all
std::vector<std::uint8_t> flagKept(const Points& points, const NeighborLists& lists,
                                   std::optional<float> common_reach = {});

/// The distance within which 95 % of all points reach their k-th neighbour, of all such distances (not empty).
float commonReach(std::vector<float> reaches);

} // namespace pointrt::surface

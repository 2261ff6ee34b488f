// SPDX-License-Identifier: GPL-3.0-or-later
// The smallest discs that close the surface.
#pragma once

#include <optional>
#include <vector>

#include "preprocess/surface/neighbors.h"

namespace pointrt::surface {

/// Radius of each point's disc, in the unit of positions: the distance to the farthest corner of its Voronoi cell in
/// the tangent plane, so that the discs of all points together cover it, times an overlap of 1.4, or 1.2 at least where
/// the disc would stick out of a ridge or over an open border. Corners further away than the surface's own holes could
/// be (an open border, a lone point) or with nothing behind them do not count. Points scattered in space stay as wide
/// as half the way to their second neighbour: sheets are what sheetShares says. oriented says that normals tell the two
/// sides of a thin sheet apart. > 0 and finite for every point.
std::vector<float> discRadii(const Points& points, const NeighborLists& lists, const NearestSearch& search,
                             const std::vector<float>& sheets, bool oriented, const StageShare& share);

/// Shrinks the radii of points that were moved out of noise, of a deviation above 0: they lie one behind the other
/// where they were read, so that a surface has more of them than its spacing says.
void tightenSmoothed(std::vector<float>& radii, const std::vector<float>& noise);

/// Shrinks discs far wider than those around them, where the points lie in no plane: in crowns and hedges, at edges and
/// among strays they hang as plates between what was sampled closer. lists are those of discRadii.
void shrinkPlates(std::vector<float>& radii, const Points& points, const NeighborLists& lists);

/// Shrinks the few radii far above all others. Points far apart are each other's neighbours, and no local rule tells
/// their spacing from a surface's: their discs would hang in the picture like sails.
/// @param decided for a larger cloud: the widest
void limitRadii(std::vector<float>& radii, std::optional<float> decided);

/// How wide the discs of so many may be: which of the radii, counted from the least, tells it, and how many times as
/// wide; nothing where there are too few to tell.
struct RadiusLimitRule {
    std::size_t place = 0;
    float times = 1;
};
std::optional<RadiusLimitRule> radiusLimitRule(std::size_t count);

/// The widest that a disc of a cloud may be, by the radii of all; infinity: of too few to tell. Changes their order.
float radiusLimit(std::vector<float>& radii);

} // namespace pointrt::surface

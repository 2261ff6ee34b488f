// SPDX-License-Identifier: GPL-3.0-or-later
// Neighbourhoods that surround their points, where the nearest neighbours are on a line or in a clump.
#pragma once

#include "preprocess/surface/neighbors.h"

namespace pointrt::surface {

/// Replaces the lists of points whose nearest neighbours do not surround them because they are on a line, as in the
/// sweep of a lidar, or in a clump, as in merged frames of a sensor that stood still. The nearer half stays, the other
/// half are points around: of thinned clouds whose cells double in width, in which a clump counts as one point, until
/// they leave no gap of a third of a turn. At a border, where a gap stays at four times the distance, and in corners,
/// takes points many of which have such lists. Leaves lists for which there is no plane (a wire), and those at borders
/// of even samplings. Sets thinned and the spacings of these lists. Does nothing for fewer than 8 neighbours, nor to
/// clouds with hardly any such list.
void surroundNeighborhoods(NeighborLists& lists, const PointSet& points, const NearestSearch& nearest,
                           const StageShare& share);

} // namespace pointrt::surface

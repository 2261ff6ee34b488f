// SPDX-License-Identifier: GPL-3.0-or-later
// Neighbourhoods on scan lines: points much closer along one direction than across it, as in the sweep of a lidar.
#pragma once

#include "preprocess/surface/neighbors.h"

namespace pointrt::surface {

/// Widens the lists of points whose neighbours are on a line, so that they include adjacent lines: keeps the nearer
/// half, and picks the other half evenly from the 4 k nearest, or from the 16 k nearest if those are on a line, too.
/// Leaves lists that would still be lines (a wire).
void widenLineNeighborhoods(NeighborLists& lists, const PointSet& points, const NearestSearch& search,
                            const StageShare& share);

} // namespace pointrt::surface

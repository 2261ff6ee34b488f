// SPDX-License-Identifier: GPL-3.0-or-later
// Scan lines: points that stand far closer along one direction than across, as in the sweep of a lidar.
#pragma once

#include "preprocess/surface/neighbors.h"

namespace pointrt::surface {

/// Gives points whose neighbours lie along a line a list that reaches the next lines: the nearer half of the
/// neighbours stays, the other half is picked evenly from the 4 k nearest, or the 16 k nearest if that is a line too.
/// Lists that stay lines even so (a wire) are left as they are.
void spreadLines(NeighborLists& lists, const Points& points, const NearestSearch& search, const StageShare& share);

} // namespace pointrt::surface

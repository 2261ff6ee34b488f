// SPDX-License-Identifier: GPL-3.0-or-later
// Which splats of a tile's children become one.
#pragma once

#include <cstdint>
#include <vector>

#include "preprocess/tiles/merge_disc.h"

namespace pointrt {

/// Groups of discs: those of group g are members[first[g]] to members[first[g + 1] - 1].
struct MergeGroups {
    std::vector<std::uint32_t> first, members;
};

/// The unit cube, which is the parent's core, is halved until at most about a thousand discs are in a region, and each
/// region cut into so many cells along each axis that the groups, of one cell and one side each and none of them long
/// and thin, are about a share of its discs. On a surface that makes cells about two of its spacings wide, where discs
/// turn every way larger ones. All cells end at the regions' borders, and those at the core's.
/// @param discs within the unit cube, along a Morton curve
/// @param share in (0, 1]
/// The result does not depend on the number of threads.
MergeGroups findMergeGroups(const MergeDiscs& discs, double share, bool oriented);

} // namespace pointrt

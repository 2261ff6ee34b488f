// SPDX-License-Identifier: GPL-3.0-or-later
// Groups the splats of a tile's children that are to be merged.
#pragma once

#include <cstdint>
#include <vector>

#include "preprocess/tiles/merge_disc.h"

namespace pointrt {

/// Groups of discs: those of group g are members[first[g]] to members[first[g + 1] - 1].
struct MergeGroups {
    std::vector<std::uint32_t> first, members;
};

/// Halves the unit cube, the parent's core, until regions have at most about a thousand discs, and divides each region
/// into cells such that the number of groups, each of one cell and one side and none long and thin, is about a share of
/// its discs. On a surface cells are about two spacings wide; where discs face all directions they are larger. Cells do
/// not cross regions, nor regions the core.
/// @param discs within the unit cube, along a Morton curve
/// @param share in (0, 1]
/// The result does not depend on the number of threads.
MergeGroups findMergeGroups(const MergeDiscs& discs, double share, bool oriented);

} // namespace pointrt

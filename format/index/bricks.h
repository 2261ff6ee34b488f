// SPDX-License-Identifier: Apache-2.0
// Bricks: each filled cell of the entry grid has 4 x 4 x 4 cells with a list of discs each. Octree leaves are wide,
// because every border costs references, but rays need short lists.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <vector>

#include "format/index/entry_grid.h"
#include "format/index/page_vector.h"
#include "pointrt/pro.h"
#include "pointrt/pro_index_layout.h"

namespace pointrt {

/// The words that the shaders read (layout: pointrt/pro_index_layout.h).
struct Bricks {
    std::vector<Corner> corners; ///< lowest corner of each brick, in position steps
    std::uint32_t brick_count = 0;
    Words words;    ///< PRO_BRICK_WORDS per brick, then groups; kEmptyWord for empty cells
    Words cells;    ///< PRO_CELL_WORDS per listed cell
    Words slabs;    ///< one per listed cell
    Words near;     ///< PRO_NEAR_WORDS per near splat
    Words listed;   ///< the splat of each near splat
    Words blending; ///< splats that only blend in a cell, two numbers per word
};

/// Limits set by the number of bits for indices.
struct BrickLimits {
    std::size_t cells = std::size_t{1} << (32 - PRO_CELL_INDEX_SHIFT); ///< also of groups, counting 8 per brick
    std::size_t listed = PRO_INDEX_LISTED_MAX;                         ///< near splats and blending numbers
};

struct IndexOptions {
    std::size_t threads = 0;              ///< maximum number; 0: one per core
    std::function<void(double)> progress; ///< fraction done, 0 to 1; called from any thread, one call at a time
    BrickLimits limits{};
};

/// Builds a brick for each cell of the grid that discs cross. If they exceed the limits, replaces grid by a coarser
/// one, one octree level at a time. Throws std::bad_alloc, or Error (kCannotRun) if no level is left or the list of a
/// cell is too long.
/// @param info,view content of a validated file
Bricks buildBricks(const pro_info& info, const pro_view& view, EntryGrid& grid, const IndexOptions& options = {});

} // namespace pointrt

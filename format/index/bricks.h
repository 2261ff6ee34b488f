// SPDX-License-Identifier: Apache-2.0
// The file's leaves are wide, because every border costs references; rays want short lists. So each filled cell of the
// entry grid becomes a brick of 4 x 4 x 4 cells, with a list for each cell that a disc crosses.
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
    std::vector<Corner> corners; ///< of each brick, lowest, in position steps
    std::uint32_t brick_count = 0;
    Words words;    ///< PRO_BRICK_WORDS for each brick, then groups; empty ones kEmptyWord
    Words cells;    ///< PRO_CELL_WORDS for each listed cell
    Words slabs;    ///< one for each listed cell
    Words near;     ///< PRO_NEAR_WORDS for each near splat
    Words listed;   ///< which splat that is
    Words blending; ///< what only blends in each cell, two numbers to a word
};

/// How many of each the words that name them allow.
struct BrickLimits {
    std::size_t cells = std::size_t{1} << (32 - PRO_CELL_INDEX_SHIFT); ///< and groups, bricks as 8 of them
    std::size_t listed = PRO_INDEX_LISTED_MAX;                         ///< near splats and what blends
};

struct IndexOptions {
    std::size_t threads = 0;              ///< at most; 0 is all cores
    std::function<void(double)> progress; ///< share done in [0, 1]; from any thread, one at a time
    BrickLimits limits{};
};

/// Builds the bricks of a validated file, for all cells of its grid that discs cross. Where they would outgrow the
/// limits, grid is framed anew, a depth less each time. Throws std::bad_alloc, or Error (kCannotRun) when no depth is
/// left or a cell's list outgrows its word.
Bricks buildBricks(const pro_info& info, const pro_view& view, EntryGrid& grid, const IndexOptions& options = {});

} // namespace pointrt

// SPDX-License-Identifier: Apache-2.0
// The file's leaves are wide, because every border costs references; rays want short lists. So each filled cell of the
// entry grid becomes a brick of 4 x 4 x 4 cells, with a list for each cell that a disc crosses.
#pragma once

#include <cstdint>
#include <vector>

#include "pointrt/pro.h"
#include "runtime/entry_grid.h"
#include "runtime/page_vector.h"

namespace pointrt {

/// The words that the shaders read (layout: shaders/brick_layout.h).
struct Bricks {
    std::vector<Corner> corners; ///< of each brick, lowest, in position steps
    Words words;                 ///< BRICK_WORDS for each brick, then groups; empty ones kEmptyWord
    Words cells;                 ///< CELL_WORDS for each listed cell
    Words slabs;                 ///< one for each listed cell
    Words near;                  ///< NEAR_WORDS for each disc that crosses a cell, each cell's padded to even
    Words lists;                 ///< the splats of near, then those that only blend; whole texels of four
    Words blend_ranges;          ///< BLEND_RANGE_WORDS for each listed cell: first in lists, count
};

/// An empty word before its skips are known: one cell in each direction.
constexpr std::uint32_t kEmptyWord = 0x11111111u;

/// Builds the bricks of a validated file, for all cells of its grid that discs cross, on all cores. Throws
/// std::bad_alloc, or Error (kCannotRun) when the lists outgrow their words.
Bricks buildBricks(const pro_info& info, const pro_view& view, const EntryGrid& grid);

} // namespace pointrt

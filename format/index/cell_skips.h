// SPDX-License-Identifier: Apache-2.0
// Skips: sizes of the empty cubes at empty cells of bricks, and of the grid near bricks.
#pragma once

#include <cstdint>

#include "format/index/entry_grid.h"
#include "format/index/page_vector.h"

namespace pointrt {

/// Writes the skips of empty brick cells (pointrt/pro_index_layout.h), which extend into neighbouring bricks and grid
/// cells, and extends those of empty grid cells into nearby bricks.
/// @param grid from fillEntryGrid
/// @param words PRO_BRICK_WORDS per brick in the order of the grid, kEmptyWord for empty cells; words after these are
/// unchanged
/// @param threads maximum number; 0: one per core
void fillCellSkips(EntryGrid& grid, std::size_t brick_count, Words& words, std::size_t threads = 0);

} // namespace pointrt

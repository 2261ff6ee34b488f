// SPDX-License-Identifier: Apache-2.0
// How far rays may go from an empty cell of a brick, or of the grid near bricks, before anything can be near.
#pragma once

#include <cstdint>

#include "format/index/entry_grid.h"
#include "format/index/page_vector.h"

namespace pointrt {

/// Writes the skips of the bricks' empty cells (pointrt/pro_index_layout.h), which see into the bricks and grid cells
/// around, and lets those of empty grid cells near bricks reach into these. grid: as by fillEntryGrid. words:
/// PRO_BRICK_WORDS for each of brick_count bricks, in the grid's order, empty ones kEmptyWord; what follows stays.
/// threads: at most; 0 is all cores.
void fillCellSkips(EntryGrid& grid, std::size_t brick_count, Words& words, std::size_t threads = 0);

} // namespace pointrt

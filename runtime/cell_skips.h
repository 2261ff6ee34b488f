// SPDX-License-Identifier: Apache-2.0
// How far rays may go from a brick's empty cell before anything can be near.
#pragma once

#include <cstdint>

#include "runtime/entry_grid.h"
#include "runtime/page_vector.h"

namespace pointrt {

/// Writes the skips of the bricks' empty cells (shaders/brick_layout.h), which see into the bricks and grid cells
/// around. words: BRICK_WORDS for each of brick_count bricks, in the grid's order, empty ones kEmptyWord; what follows
/// stays.
void fillCellSkips(const EntryGrid& grid, std::size_t brick_count, Words& words);

} // namespace pointrt

// SPDX-License-Identifier: Apache-2.0
// Neighbouring cells list the same splats over and over. So the near splats of a block of cells stand in a row, each
// cell's side by side, and where one cell's end the next one's have begun: what both list stands there once.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "format/index/cell_codec.h"

namespace pointrt {

using Discs = std::vector<const CellDisc*>;

/// What a cell lists: discs that cross it, and those whose slabs alone do.
struct CellLists {
    Discs hittable, blending;
};

struct ListedCell {
    CellLists lists; ///< at most PRO_CELL_LISTED_MAX in all, something to hit
    CellBox box{};
};

/// What cells are written to.
struct CellWords {
    std::vector<std::uint32_t> cells;  ///< PRO_CELL_WORDS each
    std::vector<std::uint32_t> slabs;  ///< one word each
    std::vector<std::uint32_t> near;   ///< PRO_NEAR_WORDS for each near splat, an even number of them
    std::vector<std::uint32_t> listed; ///< the splat for each of those
    std::vector<std::int16_t>
        blending; ///< from a cell's first near splat to one that only blends there; even numbers for each cell
};

/// Appends the cells, in their order. block: a cube that holds them all, in halves of which they are cells.
void encodeCells(std::span<const ListedCell> cells, const CellBox& block, CellWords& out);

} // namespace pointrt

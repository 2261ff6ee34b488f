// SPDX-License-Identifier: Apache-2.0
// Neighbouring cells list mostly the same splats. So the near splats of a block of cells are stored in a row in which
// each cell has a contiguous range, and ranges overlap: splats common to consecutive cells are stored once.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "format/index/cell_codec.h"

namespace pointrt {

using Discs = std::vector<const CellDisc*>;

/// The lists of a cell: discs that cross it, and discs whose slab alone crosses it.
struct CellLists {
    Discs hittable, blending;
};

struct ListedCell {
    CellLists lists; ///< at most PRO_CELL_LISTED_MAX in all; hittable is not empty
    CellBox box{};
};

/// Encoded cells.
struct CellWords {
    std::vector<std::uint32_t> cells;  ///< PRO_CELL_WORDS each
    std::vector<std::uint32_t> slabs;  ///< one word each
    std::vector<std::uint32_t> near;   ///< PRO_NEAR_WORDS per near splat, an even number of them
    std::vector<std::uint32_t> listed; ///< the splat of each near splat
    std::vector<std::int16_t>
        blending; ///< offset from a cell's first near splat to one that only blends there; an even count per cell
};

/// Appends the cells in order. @param block a cube whose repeated halving gives the cells
void encodeCells(std::span<const ListedCell> cells, const CellBox& block, CellWords& out);

} // namespace pointrt

// SPDX-License-Identifier: Apache-2.0
// Which cells a disc, or the slab in which it blends, can meet. None that it meets is left out; some may be too many.
#pragma once

#include <cstdint>

#include "format/index/cell_codec.h"

namespace pointrt {

/// Whether disc (slab 0) or slab (its half height) can meet the cell: its bounding box, its planes and its sphere all
/// do.
bool mayMeet(const CellDisc& disc, const CellBox& box, float slab);

/// Whether the disc meets the cell, by its section as well (disc_section.h).
bool meets(const CellDisc& disc, const CellBox& box);

/// Cells of a brick, a bit each.
struct CellSets {
    std::uint64_t by_disc = 0, by_slab = 0;
};

/// mayMeet by slab, and meets, for all cells of a brick at once. Lengths are in edges of its cells; offset is its
/// lowest corner, slack by how much cells are taken larger.
CellSets cellsMet(const CellDisc& disc, const Vector& offset, float slack);

} // namespace pointrt

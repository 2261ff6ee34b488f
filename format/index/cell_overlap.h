// SPDX-License-Identifier: Apache-2.0
// Conservative overlap tests of cells with discs and their blending slabs: no overlap is missed.
#pragma once

#include <cstdint>

#include "format/index/cell_codec.h"

namespace pointrt {

/// Whether the bounding box, the planes and the sphere of a disc's slab all overlap the cell.
/// @param slab half its height; 0 for the disc alone
bool mayOverlap(const CellDisc& disc, const CellBox& box, float slab);

/// Whether the disc overlaps the cell: the tests of mayOverlap, and one of the disc's section (disc_section.h).
bool overlaps(const CellDisc& disc, const CellBox& box);

/// Sets of cells of a brick, one bit per cell.
struct CellSets {
    std::uint64_t by_disc = 0, by_slab = 0;
};

/// mayOverlap for the slab and overlaps for the disc, for all cells of a brick at once. Lengths are in edges of its
/// cells.
/// @param offset lowest corner of the brick
/// @param slack enlarges the cells
CellSets overlappedCells(const CellDisc& disc, const Vector& offset, float slack);

} // namespace pointrt

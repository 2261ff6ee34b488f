// SPDX-License-Identifier: GPL-3.0-or-later
// Divides space into tiles: an octree over counted cells, split until its cells hold about as many points as a tile
// should have.
#pragma once

#include "preprocess/tiles/count_grid.h"
#include "preprocess/tiles/plan.h"

namespace pointrt {

struct TileChoice {
    std::uint64_t points_per_tile = 1'000'000; ///< approximate
    std::uint64_t most_points = 0;             ///< hard limit of a tile; 0: none
    bool leaves_out_strays = true;
};

/// Fills in the plan's lattice, levels, tiles, blocks and point counts from the counts of all points in cells whose
/// edge is a power of two. Splits cells with more than one and a half times points_per_tile. Makes no tiles for strays
/// (small groups of points a hundred times as far off as 99% of all), unless they are to be kept. There are at most
/// 2,000 blocks, of at least four tiles' points each. Throws Error (kCannotRun, without the input's name) if points lie
/// too close together to be split.
void chooseTiles(std::vector<CountedCell> cells, double edge, const TileChoice& choice, SetPlan& plan);

} // namespace pointrt

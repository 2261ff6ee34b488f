// SPDX-License-Identifier: GPL-3.0-or-later
// Where space is cut: an octree over counted cells, split until its cells hold about as many points as a tile is to
// have.
#pragma once

#include "preprocess/tiles/count_grid.h"
#include "preprocess/tiles/plan.h"

namespace pointrt {

struct TileChoice {
    std::uint64_t points_per_tile = 1'000'000; ///< about
    std::uint64_t most_points = 0;             ///< that a tile may have at all; 0: any number
    bool leaves_out_strays = true;
};

/// Fills in the plan's lattice, levels, tiles, blocks and counts of points, given all points' counts in cells of an
/// edge that is a power of two. Cells are split that hold more than one and a half times points_per_tile; of few points
/// that lie a hundred times as far off as 99% of all, no tiles are made, unless they are to stay. Blocks are of four
/// tiles' points and more, and no more than 2,000.
/// Throws Error (kCannotRun, without the input's name) where points lie so close that no cut parts them.
void chooseTiles(std::vector<CountedCell> cells, double edge, const TileChoice& choice, SetPlan& plan);

} // namespace pointrt

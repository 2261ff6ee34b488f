// SPDX-License-Identifier: GPL-3.0-or-later
// Points of tiles to the tiles' own splats.
#pragma once

#include <string>

#include "preprocess/cloud/stage_progress.h"
#include "preprocess/tiles/lanes.h"
#include "preprocess/tiles/plan.h"
#include "preprocess/tiles/tile_splats.h"
#include "preprocess/tiles/tile_tree.h"

namespace pointrt {

/// The set's lattice and world, without tiles.
TileSet latticeOf(const SetPlan& plan);
/// The plan's tiles and their ancestors.
TileTree treeOf(const SetPlan& plan);
inline TileKey keyOf(const PlanTile& tile) { return {tile.level, tile.cell}; }

/// What became of points.
struct TileCounts {
    std::uint64_t points = 0, splats = 0;
    std::uint64_t outliers = 0; ///< with those of halos
    std::uint64_t filled = 0;   ///< splats that fill gaps between points
    std::uint64_t lacking = 0;  ///< points whose neighbours may lie outside of what was read around their tile

    TileCounts operator+(const TileCounts& other) const {
        return {points + other.points, splats + other.splats, outliers + other.outliers, filled + other.filled,
                lacking + other.lacking};
    }
};

/// Estimates the surface around a tile's points by the code that single files use, from these and a halo of others, and
/// takes what is its own: the splats of its core's points, wherever cleaning moved them, and what fills gaps in its
/// core. A tile whose points make no surface has none. The result depends on the plan and the buckets alone. Throws
/// Error (kBadInput).
/// @param number of the tile in the plan
/// @param room of which it takes as many points as it reads
TileSplats bakeTile(const SetPlan& plan, const TileTree& tree, std::uint32_t number, PointRoom& room,
                    TileCounts& counts);

/// bakeTile and a splat file for each tile of the blocks that has none yet. progress hears of the stage "tiles".
/// @param threads that all of it may use
TileCounts bakeBlocks(const SetPlan& plan, BlockRange blocks, std::size_t threads, const StageProgress& progress = {});

} // namespace pointrt

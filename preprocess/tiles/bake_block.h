// SPDX-License-Identifier: GPL-3.0-or-later
// Estimates the splats of tiles from their points.
#pragma once

#include <string>

#include "preprocess/cloud/stage_progress.h"
#include "preprocess/tiles/plan.h"
#include "preprocess/tiles/tile_scheduler.h"
#include "preprocess/tiles/tile_splats.h"
#include "preprocess/tiles/tile_tree.h"

namespace pointrt {

/// The set's lattice and world, without tiles.
TileSet latticeOf(const SetPlan& plan);
/// The tree of the plan's tiles and their ancestors.
TileTree treeOf(const SetPlan& plan);
inline TileKey keyOf(const PlanTile& tile) { return {tile.level, tile.cell}; }

/// Counts of points and splats.
struct TileCounts {
    std::uint64_t points = 0, splats = 0;
    std::uint64_t outliers = 0; ///< including those in halos
    std::uint64_t filled = 0;   ///< splats added to fill gaps between points
    std::uint64_t balls = 0;    ///< splats that are balls
    std::uint64_t lacking = 0;  ///< points whose neighbours may lie outside the halo that was read

    TileCounts operator+(const TileCounts& other) const {
        return {points + other.points, splats + other.splats, outliers + other.outliers,
                filled + other.filled, balls + other.balls,   lacking + other.lacking};
    }
};

/// Estimates the surface around a tile with the code for single files, from the tile's points and a halo of others, and
/// returns the tile's own splats: those of its core's points, wherever cleaning moved them, and those that fill gaps in
/// its core. Returns none if the points do not form a surface. The result depends on the plan and the buckets only.
/// Throws Error (kBadInput).
/// @param number index of the tile in the plan
/// @param budget memory, from which the points read are reserved
TileSplats bakeTile(const SetPlan& plan, const TileTree& tree, std::uint32_t number, PointBudget& budget,
                    TileCounts& counts);

/// Bakes each tile of the blocks that has no splat file yet, and writes the file. Reports progress as stage "tiles".
/// @param threads to use in all
TileCounts bakeBlocks(const SetPlan& plan, BlockRange blocks, std::size_t threads, const StageProgress& progress = {});

} // namespace pointrt

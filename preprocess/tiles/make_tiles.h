// SPDX-License-Identifier: GPL-3.0-or-later
// Makes the set from the splats of all tiles: coarser levels, tiles, set.json. Each step does what is still missing,
// whichever process did the rest.
#pragma once

#include "preprocess/cloud/stage_progress.h"
#include "preprocess/tiles/build_tile.h"
#include "preprocess/tiles/plan.h"

namespace pointrt {

/// Makes the splat files of the coarser levels, bottom up. All blocks must have been baked. Reports progress as stage
/// "levels". Throws Error.
/// @param tile_splats approximate limit of a merged tile's splats
/// @param threads to use in all
void mergeLevels(const SetPlan& plan, std::uint64_t tile_splats, std::size_t threads,
                 const StageProgress& progress = {});

/// Makes the tiles of some blocks; reads data of the whole set once. mergeLevels must have run. Reports progress as
/// stage "tiles".
/// @param metadata JSON object for META: TileOptions::metadata
/// @param threads to use in all
void makeBlockTiles(const SetPlan& plan, BlockRange blocks, const std::string& metadata, std::size_t threads,
                    const StageProgress& progress = {});

/// Makes all missing tiles, including merged ones, and set.json. mergeLevels must have run. Throws Error (kBadInput) if
/// no tile has a splat.
TileSet makeSet(const SetPlan& plan, const std::string& metadata, std::size_t threads,
                const StageProgress& progress = {});

} // namespace pointrt

// SPDX-License-Identifier: GPL-3.0-or-later
// Splats of all tiles to the set: coarser levels, tiles, set.json. Each step does what is not done yet, and nothing of
// it depends on who did the rest.
#pragma once

#include "preprocess/cloud/stage_progress.h"
#include "preprocess/tiles/build_tile.h"
#include "preprocess/tiles/plan.h"

namespace pointrt {

/// Splat files of the coarser levels, bottom up. All blocks must have been baked. progress hears of "levels".
/// Throws Error.
/// @param tile_splats of a merged tile about so many at the most
/// @param threads that all of it may use
void mergeLevels(const SetPlan& plan, std::uint64_t tile_splats, std::size_t threads,
                 const StageProgress& progress = {});

/// The tiles of some blocks, for which what is known of the whole set is read once. mergeLevels must have run. progress
/// hears of "tiles".
/// @param metadata JSON object for META: TileOptions::metadata
/// @param threads that all of it may use
void makeBlockTiles(const SetPlan& plan, BlockRange blocks, const std::string& metadata, std::size_t threads,
                    const StageProgress& progress = {});

/// All tiles that are not there yet, merged ones too, and set.json. mergeLevels must have run. Throws Error, kBadInput
/// where no tile has a splat.
TileSet makeSet(const SetPlan& plan, const std::string& metadata, std::size_t threads,
                const StageProgress& progress = {});

} // namespace pointrt

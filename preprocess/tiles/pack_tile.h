// SPDX-License-Identifier: GPL-3.0-or-later
// Packs a tile's splats into the words of its file.
#pragma once

#include "preprocess/octree/quantize.h"
#include "preprocess/tiles/level_coding.h"
#include "preprocess/tiles/tile_splats.h"

namespace pointrt {

/// PackedSplats of a tile. input_index refers to `splats`, for their attributes.
/// The cube is the tile's. Keeps all splats of one position, in their order, so that neighbours agree on them.
/// @param splats in codes of the tile, within its cube; at least one
PackedSplats packTile(const TileSet& set, const TileKey& tile, const LevelCoding& coding, const TileSplats& splats);

} // namespace pointrt

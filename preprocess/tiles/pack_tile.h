// SPDX-License-Identifier: GPL-3.0-or-later
// A tile's splats as the words of its file.
#pragma once

#include "preprocess/octree/quantize.h"
#include "preprocess/tiles/level_coding.h"
#include "preprocess/tiles/tile_splats.h"

namespace pointrt {

/// PackedSplats of a tile. Its input_index are numbers in splats, for their attributes.
/// The cube is the tile's; splats of one position all stay, in their order, so that neighbours agree on them.
/// @param splats seen from the tile, in its cube; at least one
PackedSplats packTile(const TileSet& set, const TileKey& tile, const LevelCoding& coding, const TileSplats& splats);

} // namespace pointrt

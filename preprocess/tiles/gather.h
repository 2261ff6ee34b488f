// SPDX-License-Identifier: GPL-3.0-or-later
// What a tile's file holds: the splats whose centres lie in its core, and those of its neighbours that its core's hits
// need.
#pragma once

#include "preprocess/tiles/tile_splats.h"

namespace pointrt {

/// Splats in one tile's cube, seen from it.
struct GatheredSplats {
    TileSplats splats;
    std::uint64_t own = 0; ///< of them, those whose centres lie in the core
};

/// Appends the splats of one source, the tile's own or a neighbour's, with centres in the core, and those whose slabs
/// come within a radius of theirs of the core: a ray that hits a disc in the core blends what lies within its slab
/// there, and the blended surface may lie a slab's height off the disc. Splats whose centres no code of the tile's cube
/// can name are left out: their radii are at most half of the cube's rim, so they do not reach the core.
/// @param edge of the tile's core, input units
void gatherSplats(const TileKey& tile, double edge, const TileKey& from, const SplatsView& splats,
                  GatheredSplats& gathered);

} // namespace pointrt

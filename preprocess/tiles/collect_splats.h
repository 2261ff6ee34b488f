// SPDX-License-Identifier: GPL-3.0-or-later
// Collects the splats of a tile's file: those with centres in its core, and those of its neighbours that hits in its
// core need.
#pragma once

#include "preprocess/tiles/tile_splats.h"

namespace pointrt {

/// Splats in one tile's cube, in its codes.
struct CollectedSplats {
    TileSplats splats;
    std::uint64_t own = 0; ///< splats whose centres lie in the core
};

/// Appends the splats of one file, the tile's own or a neighbour's, with centres in the core, and those whose slabs
/// come within one radius of the core: a ray that hits a disc in the core blends all discs within its slab there, and
/// the blended surface may lie a slab's height off the disc. Splats with centres outside the tile's cube cannot be
/// coded and are skipped: their radii are at most half of the cube's rim, so they do not touch the core.
/// @param edge of the tile's core, input units
void collectSplats(const TileKey& tile, double edge, const TileKey& from, const SplatsView& splats,
                   CollectedSplats& collected);

} // namespace pointrt

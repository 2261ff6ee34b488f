// SPDX-License-Identifier: Apache-2.0
// The box that a tile's hits are clipped to: its core, extended where no other tile has hits.
#pragma once

#include <cstdint>
#include <vector>

#include "format/set/tile_set.h"

namespace pointrt {

/// The core, extended on each of its six sides
///  - towards a coarser tile of the cut by the error of that tile: the two surfaces may be that far apart;
///  - towards a cell without splats, which has no tile, by the largest radius of the level: discs extend into it.
/// @param in_cut whether each tile of the set is in the cut
/// @param tile a tile of the cut
TileBox hitBox(const TileSet& set, const std::vector<bool>& in_cut, std::uint32_t tile);

} // namespace pointrt

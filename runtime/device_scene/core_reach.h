// SPDX-License-Identifier: Apache-2.0
// How far the hits of a tile count: in its core, and beyond where nobody else's would.
#pragma once

#include <cstdint>
#include <vector>

#include "format/set/tile_set.h"

namespace pointrt {

/// The core, grown on each of its six sides
///  - towards a coarser tile of the cut by that one's error: so far may its surface lie beside this one's;
///  - towards a cell without splats, which has no tile, by the largest radius of the level: discs reach into it.
/// in_cut: of each tile of the set, whether it is in the cut; tile: one that is
TileBox hitBox(const TileSet& set, const std::vector<bool>& in_cut, std::uint32_t tile);

} // namespace pointrt

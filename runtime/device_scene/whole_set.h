// SPDX-License-Identifier: Apache-2.0
// What stands for a whole set where nobody looks at it yet: original tiles, as far as they have few splats.
#pragma once

#include <cstdint>
#include <vector>

#include "format/set/tile_set.h"

namespace pointrt {

/// A tile, and the original splats that it stands for: its own, or those of the original tiles below it.
struct TileShare {
    std::uint32_t tile = 0;
    std::uint64_t originals = 0;
};

/// A cut through the set's tree with so many splats at the most, those that neighbours repeat included, but for the
/// root's, in the order of the set: refined from the root down, each time the tile that stands for the most original
/// splats, of those whose children still fit. children: childrenOf(set)
std::vector<TileShare> tilesOfWhole(const TileSet& set, const std::vector<std::vector<std::uint32_t>>& children,
                                    std::uint64_t most);

} // namespace pointrt

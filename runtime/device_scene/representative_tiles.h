// SPDX-License-Identifier: Apache-2.0
// A small set of tiles that represents a whole tile set, before any camera is known: the original tiles if they have
// few splats.
#pragma once

#include <cstdint>
#include <vector>

#include "format/set/tile_set.h"

namespace pointrt {

/// A tile, and the number of original splats that it represents: its own, or those of the original tiles below it.
struct TileShare {
    std::uint32_t tile = 0;
    std::uint64_t originals = 0;
};

/// A cut of the set with at most `most` stored splats, including those repeated by neighbours; the root is exempt.
/// Refines from the root down, always the tile that represents the most original splats, if its children still fit.
/// @param children childrenOf(set)
/// @return in the order of the set
std::vector<TileShare> representativeTiles(const TileSet& set, const std::vector<std::vector<std::uint32_t>>& children,
                                           std::uint64_t most);

} // namespace pointrt

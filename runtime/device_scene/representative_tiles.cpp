// SPDX-License-Identifier: Apache-2.0
#include "runtime/device_scene/representative_tiles.h"

#include <algorithm>
#include <queue>

namespace pointrt {
namespace {

/// Original splats at or below each tile. Children follow their parents.
std::vector<std::uint64_t> originalsOf(const TileSet& set, const std::vector<std::vector<std::uint32_t>>& children) {
    std::vector<std::uint64_t> originals(set.tiles.size());
    for (std::size_t tile = set.tiles.size(); tile-- > 0;) {
        if (set.tiles[tile].isOriginal()) originals[tile] = set.tiles[tile].splats;
        for (const std::uint32_t child : children[tile]) originals[tile] += originals[child];
    }
    return originals;
}

} // namespace

std::vector<TileShare> representativeTiles(const TileSet& set, const std::vector<std::vector<std::uint32_t>>& children,
                                           std::uint64_t most) {
    const std::vector<std::uint64_t> originals = originalsOf(set, children);
    const auto is_less = [&](std::uint32_t a, std::uint32_t b) {
        return originals[a] != originals[b] ? originals[a] < originals[b] : a > b;
    };
    std::priority_queue<std::uint32_t, std::vector<std::uint32_t>, decltype(is_less)> coarse(is_less);
    coarse.push(0);
    std::vector<TileShare> tiles;
    std::uint64_t splats = set.tiles[0].stored;
    while (!coarse.empty()) {
        const std::uint32_t tile = coarse.top();
        coarse.pop();
        std::uint64_t finer = splats - set.tiles[tile].stored;
        for (const std::uint32_t child : children[tile]) finer += set.tiles[child].stored;
        if (children[tile].empty() || finer > most) {
            tiles.push_back({tile, originals[tile]});
            continue;
        }
        splats = finer;
        for (const std::uint32_t child : children[tile]) coarse.push(child);
    }
    std::sort(tiles.begin(), tiles.end(), [](const TileShare& a, const TileShare& b) { return a.tile < b.tile; });
    return tiles;
}

} // namespace pointrt

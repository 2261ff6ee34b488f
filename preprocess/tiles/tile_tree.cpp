// SPDX-License-Identifier: GPL-3.0-or-later
#include "preprocess/tiles/tile_tree.h"

#include <algorithm>

#include "format/base/error.h"

namespace pointrt {

namespace {

bool isBefore(const TileKey& a, const TileKey& b) {
    SetTile tile_a, tile_b;
    tile_a.level = a.level;
    tile_a.cell = a.cell;
    tile_b.level = b.level;
    tile_b.cell = b.cell;
    return isTileBefore(tile_a, tile_b);
}

/// Whether the core of a tile overlaps the cube of another tile of the same or a higher level.
bool overlapsCube(const TileKey& tile, const TileKey& around) {
    const std::uint32_t up = around.level - tile.level;
    for (std::size_t axis = 0; axis < 3; ++axis) {
        // in half edges of `tile`, integers
        const std::int64_t low = std::int64_t{tile.cell[axis]} * 2, high = low + 2;
        const std::int64_t cube_low = (2 * std::int64_t{around.cell[axis]} - 1) << up;
        const std::int64_t cube_high = (2 * std::int64_t{around.cell[axis]} + 3) << up;
        if (high <= cube_low || low >= cube_high) return false;
    }
    return true;
}

template <typename Visit>
void forNeighborCells(const TileKey& tile, const Visit& visit) {
    for (std::int32_t z = -1; z <= 1; ++z)
        for (std::int32_t y = -1; y <= 1; ++y)
            for (std::int32_t x = -1; x <= 1; ++x)
                if (x != 0 || y != 0 || z != 0)
                    visit(TileKey{tile.level, {tile.cell[0] + x, tile.cell[1] + y, tile.cell[2] + z}});
}

void arrange(std::vector<TileKey>& tiles) {
    std::sort(tiles.begin(), tiles.end(), isBefore);
    tiles.erase(std::unique(tiles.begin(), tiles.end()), tiles.end());
}

} // namespace

TileTree::TileTree(const std::vector<TileKey>& originals) {
    std::vector<TileKey> level_tiles;
    std::uint32_t level = 0, top = 0;
    for (const TileKey& tile : originals) {
        original_[tile] = true;
        top = std::max(top, tile.level);
    }
    for (bool single = false; !single; ++level) {
        if (level >= kTileSetLevelsMax)
            throw Error(ExitCode::kCannotRun, "tiles on both sides of the lattice's corner");
        for (const TileKey& tile : originals)
            if (tile.level == level) level_tiles.push_back(tile);
        arrange(level_tiles);
        tiles_.insert(tiles_.end(), level_tiles.begin(), level_tiles.end());
        single = level >= top && level_tiles.size() == 1;
        for (TileKey& tile : level_tiles) {
            tile = parentOf(tile);
            if (!single) original_.try_emplace(tile, false);
        }
        arrange(level_tiles);
    }
    arrange(tiles_);
}

bool TileTree::isOriginal(const TileKey& tile) const {
    const auto found = original_.find(tile);
    return found != original_.end() && found->second;
}

std::vector<TileKey> TileTree::childrenOf(const TileKey& tile) const {
    std::vector<TileKey> children;
    if (tile.level == 0 || isOriginal(tile)) return children;
    for (std::int32_t slot = 0; slot < 8; ++slot) {
        const TileKey child{
            tile.level - 1,
            {2 * tile.cell[0] + (slot & 1), 2 * tile.cell[1] + (slot >> 1 & 1), 2 * tile.cell[2] + (slot >> 2)}};
        if (has(child)) children.push_back(child);
    }
    return children;
}

std::optional<TileKey> TileTree::originalAt(const TileKey& tile, const PositionCode& code) const {
    TileKey at = tile;
    std::array<std::int64_t, 3> steps{}; // within the tile, in steps of its level
    for (std::size_t axis = 0; axis < 3; ++axis) {
        at.cell[axis] += code[axis] >> kCoreBits;
        steps[axis] = code[axis] & (kCoreSteps - 1);
    }
    if (!has(at)) {
        while (!has(at) && at.level < root().level) at = parentOf(at);
        return isOriginal(at) ? std::optional(at) : std::nullopt;
    }
    for (int bit = kCoreBits - 1; has(at) && !isOriginal(at); --bit) {
        if (bit < 0) return std::nullopt;
        --at.level;
        for (std::size_t axis = 0; axis < 3; ++axis)
            at.cell[axis] = 2 * at.cell[axis] + static_cast<std::int32_t>(steps[axis] >> bit & 1);
    }
    return has(at) ? std::optional(at) : std::nullopt;
}

void TileTree::addOriginalsBelow(const TileKey& tile, const TileKey& around, std::vector<TileKey>& found) const {
    if (!overlapsCube(tile, around)) return;
    if (isOriginal(tile)) return found.push_back(tile);
    for (const TileKey& child : childrenOf(tile)) addOriginalsBelow(child, around, found);
}

void TileTree::addOriginalAbove(TileKey tile, std::vector<TileKey>& found) const {
    while (!has(tile) && tile.level < root().level) tile = parentOf(tile);
    if (isOriginal(tile)) found.push_back(tile);
}

std::vector<TileKey> TileTree::neighborsOf(const TileKey& tile) const {
    const bool original = isOriginal(tile);
    std::vector<TileKey> found;
    forNeighborCells(tile, [&](const TileKey& beside) {
        if (!has(beside)) return addOriginalAbove(beside, found);
        if (original) return addOriginalsBelow(beside, tile, found);
        found.push_back(beside);
    });
    arrange(found);
    return found;
}

} // namespace pointrt

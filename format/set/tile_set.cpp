// SPDX-License-Identifier: Apache-2.0
#include "format/set/tile_set.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <string_view>
#include <system_error>

#include "format/os/separators.h"

namespace pointrt {

namespace {

/// Maps a signed coordinate to an unsigned one of the same order.
std::uint32_t raised(std::int32_t cell) { return static_cast<std::uint32_t>(cell) ^ 0x80000000u; }

/// Whether the highest bit of a is below that of b (Chan, "Closest-point problems simplified on the RAM", 2002).
bool hasLowerTop(std::uint32_t a, std::uint32_t b) { return a < b && a < (a ^ b); }

/// Morton order: the axis with the highest differing bit decides, z before y before x.
bool isCellBefore(const TileCell& a, const TileCell& b) {
    std::size_t deciding = 2;
    std::uint32_t most = raised(a[2]) ^ raised(b[2]);
    for (const std::size_t axis : {std::size_t{1}, std::size_t{0}}) {
        const std::uint32_t differing = raised(a[axis]) ^ raised(b[axis]);
        if (!hasLowerTop(most, differing)) continue;
        deciding = axis;
        most = differing;
    }
    return a[deciding] < b[deciding];
}

} // namespace

double edgeOf(const TileSet& set, std::uint32_t level) { return std::ldexp(set.edge, static_cast<int>(level)); }

TileBox coreOf(const TileSet& set, std::uint32_t level, const TileCell& cell) {
    const double edge = edgeOf(set, level);
    TileBox box;
    for (std::size_t axis = 0; axis < 3; ++axis) {
        box.low[axis] = set.lattice_origin[axis] + edge * cell[axis];
        box.high[axis] = set.lattice_origin[axis] + edge * (double{1} + cell[axis]);
    }
    return box;
}

TileBox coreOf(const TileSet& set, const SetTile& tile) { return coreOf(set, tile.level, tile.cell); }

TileCube cubeOf(const TileSet& set, const SetTile& tile) {
    const double edge = edgeOf(set, tile.level);
    const TileBox core = coreOf(set, tile);
    TileCube cube{.scale = 2 * edge};
    for (std::size_t axis = 0; axis < 3; ++axis) cube.origin[axis] = core.low[axis] - edge / 2;
    return cube;
}

TileCell parentOf(const TileCell& cell) { return {cell[0] >> 1, cell[1] >> 1, cell[2] >> 1}; }

std::string tileFileName(std::uint32_t level, const TileCell& cell) {
    std::string name = "tiles/" + std::to_string(level);
    for (const std::int32_t axis : cell) name += "-" + std::to_string(axis);
    return name + ".pro";
}

bool isTileBefore(const SetTile& a, const SetTile& b) {
    return a.level != b.level ? a.level > b.level : isCellBefore(a.cell, b.cell);
}

std::optional<std::uint32_t> findTile(const TileSet& set, std::uint32_t level, const TileCell& cell) {
    SetTile wanted;
    wanted.level = level;
    wanted.cell = cell;
    const auto found = std::lower_bound(set.tiles.begin(), set.tiles.end(), wanted, isTileBefore);
    if (found == set.tiles.end() || isTileBefore(wanted, *found)) return std::nullopt;
    return static_cast<std::uint32_t>(found - set.tiles.begin());
}

std::vector<std::vector<std::uint32_t>> childrenOf(const TileSet& set) {
    std::vector<std::vector<std::uint32_t>> children(set.tiles.size());
    for (std::uint32_t i = 0; i < set.tiles.size(); ++i) {
        const SetTile& tile = set.tiles[i];
        if (const auto parent = findTile(set, tile.level + 1, parentOf(tile.cell))) children[*parent].push_back(i);
    }
    return children;
}

void arrangeTiles(TileSet& set) {
    std::sort(set.tiles.begin(), set.tiles.end(), isTileBefore);
    set.splats = 0;
    for (SetLevel& level : set.levels) {
        level.tiles = level.splats = 0;
        level.error = 0;
    }
    for (const SetTile& tile : set.tiles) {
        SetLevel& level = set.levels[tile.level];
        ++level.tiles;
        level.splats += tile.splats;
        level.error = std::max(level.error, tile.error);
        if (tile.isOriginal()) set.splats += tile.splats;
    }
}

bool isTileSet(const std::string& path) {
    std::string_view name = path;
    while (name.size() > 1 && isFolderSeparator(name.back())) name.remove_suffix(1);
    std::error_code ignored;
    return name.ends_with(".proset") || std::filesystem::is_regular_file(setFileOf(path), ignored);
}

std::string setFileOf(const std::string& folder) { return folder + (folder.ends_with('/') ? "set.json" : "/set.json"); }

} // namespace pointrt

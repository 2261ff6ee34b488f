// SPDX-License-Identifier: Apache-2.0
// A set with tile files for tests: a wavy sheet in 2 x 2 tiles of level 0, under a root of merged splats.
#pragma once

#include <array>
#include <cmath>
#include <filesystem>
#include <string>
#include <vector>

#include "format/set/open_tile.h"
#include "scene_builder.h"

namespace pointrt::test {

constexpr std::int64_t kCoreSteps =
    1 << (PRO_POSITION_BITS - 1); ///< position steps of a tile along an edge of its core

/// A splat located by position steps of its level from the origin of the lattice.
struct LatticeSplat {
    std::array<std::int64_t, 3> code{};
    pro_splat splat{}; ///< all but the position; radius in cube units of its level
};

/// Position in the cube of the tile; outside [0, 1) if the cube does not contain it.
inline pro_splat splatInTile(const LatticeSplat& from, const TileCell& cell) {
    pro_splat splat = from.splat;
    for (std::size_t axis = 0; axis < 3; ++axis) {
        const std::int64_t code = from.code[axis] - cell[axis] * kCoreSteps + kCoreSteps / 2;
        splat.position[axis] = (static_cast<float>(code) + 0.5f) * PRO_POSITION_STEP;
    }
    return splat;
}

inline bool isInCore(const LatticeSplat& splat, const TileCell& cell) {
    for (std::size_t axis = 0; axis < 3; ++axis)
        if ((splat.code[axis] >> (PRO_POSITION_BITS - 1)) != cell[axis]) return false;
    return true;
}

/// Whether the cube contains the centre, and the box around a disc of twice the radius intersects the core.
inline bool reachesCore(const LatticeSplat& splat, const TileCell& cell) {
    const pro_splat at = splatInTile(splat, cell);
    for (std::size_t axis = 0; axis < 3; ++axis) {
        const float beyond = std::fabs(at.position[axis] - 0.5f);
        if (beyond - 2 * at.radius > 0.25f || beyond >= 0.5f) return false;
    }
    return true;
}

/// Three quarters of the spacing of a sheet in 2 x 2 cores, or of half as many splats in one core, whose edge is half
/// the edge of the cube.
inline float sheetRadius(int side) { return 0.75f / static_cast<float>(side); }

/// side x side splats of a level on which the sheet covers cells x cells cores.
inline std::vector<LatticeSplat> sheet(int side, int cells, float radius) {
    std::vector<LatticeSplat> splats;
    const std::int64_t step = kCoreSteps * cells / side;
    for (std::int64_t y = 0; y < side; ++y)
        for (std::int64_t x = 0; x < side; ++x) {
            LatticeSplat one;
            const double height = 0.5 + 0.1 * std::sin(0.4 * static_cast<double>(x + 2 * y));
            one.code = {x * step + step / 2, y * step + step / 2,
                        static_cast<std::int64_t>(height * static_cast<double>(kCoreSteps))};
            const auto shade = static_cast<std::uint8_t>(x * 255 / side);
            one.splat = {{}, {0, 0, 1}, radius, {shade, static_cast<std::uint8_t>(y * 255 / side), 99}, 0};
            splats.push_back(one);
        }
    return splats;
}

/// Writes the file of a tile: splats in its core and those that reach into it.
inline void writeTile(const TileSet& set, SetTile& tile, const std::vector<LatticeSplat>& all,
                      const std::string& folder) {
    std::vector<pro_splat> stored;
    tile.splats = 0;
    for (const LatticeSplat& each : all) {
        const bool own = isInCore(each, tile.cell);
        if (own || reachesCore(each, tile.cell)) stored.push_back(splatInTile(each, tile.cell));
        tile.splats += own;
    }
    TreeOptions options;
    options.radius_max = static_cast<float>(set.levels[tile.level].radius_max);
    options.radius_step = static_cast<float>(set.levels[tile.level].radius_step);
    Scene scene = sceneOf(stored, options);
    const TileCube cube = cubeOf(set, tile);
    scene.info.scale = cube.scale;
    scene.info.flags = PRO_FLAG_COLOR | PRO_FLAG_ORIENTED;
    for (std::size_t axis = 0; axis < 3; ++axis) {
        scene.info.origin[axis] = cube.origin[axis];
        scene.info.bounds_min[axis] = cube.origin[axis] + cube.scale * scene.info.bounds_min[axis];
        scene.info.bounds_max[axis] = cube.origin[axis] + cube.scale * scene.info.bounds_max[axis];
    }
    scene.write(tilePath(folder, tile));
    describeTile(folder, tile);
}

/// @param folder existing and empty
/// @param side of the sheet in splats, a power of 2 from 4
inline TileSet makeSet(const std::string& folder, int side = 16) {
    TileSet set;
    set.lattice_origin = {1000, 2000, 300};
    set.edge = 4;
    set.up = {0, 0, 1};
    set.colors = set.oriented = true;
    set.input_points = static_cast<std::uint64_t>(side) * static_cast<std::uint64_t>(side);
    set.levels = {{0.0625, 0.03125, 0, 0, 0}, {0.0625, 0.03125, 0, 0, 0}};
    std::filesystem::create_directory(folder + "/tiles");
    const float radius = sheetRadius(side);
    const auto fine = sheet(side, 2, radius), coarse = sheet(side / 2, 1, radius);
    for (const TileCell cell : {TileCell{0, 0, 0}, TileCell{1, 0, 0}, TileCell{0, 1, 0}, TileCell{1, 1, 0}}) {
        set.tiles.push_back({.level = 0, .cell = cell, .file = tileFileName(0, cell), .spacing = 8.0 / side});
        writeTile(set, set.tiles.back(), fine, folder);
    }
    set.tiles.push_back({.level = 1, .file = tileFileName(1, {}), .error = 0.25, .spacing = 16.0 / side});
    writeTile(set, set.tiles.back(), coarse, folder);
    set.bounds_min = {1000, 2000, 301.5};
    set.bounds_max = {1008, 2008, 304.9}; // of the merged sheet, whose bounds are higher
    arrangeTiles(set);
    writeTileSet(set, folder);
    return set;
}

} // namespace pointrt::test

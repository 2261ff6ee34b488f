// SPDX-License-Identifier: Apache-2.0
// A small valid set for tests: a root with four children, one of which has four of its own.
#pragma once

#include "format/set/tile_set.h"
#include "pointrt/pro_layout.h"

namespace pointrt::test {

inline SetTile setTile(std::uint32_t level, TileCell cell, std::uint64_t splats, double error) {
    SetTile tile;
    tile.level = level;
    tile.cell = cell;
    tile.file = tileFileName(level, cell);
    tile.splats = splats;
    tile.stored = splats + 10;
    tile.bytes = 8192 + 16 * tile.stored;
    tile.error = error;
    tile.spacing = 0.25 * (1 << level);
    tile.checksum = 0xfedcba9876543210u + tile.bytes;
    return tile;
}

/// 3 levels and 9 tiles, 7 of them original: 4 of level 0 with 100 splats each, and 3 of level 1 with 50 each. Every
/// value is fixed: golden/small.proset has this content.
inline TileSet smallSet() {
    TileSet set;
    set.lattice_origin = {634000, 848000, 400};
    set.edge = 16;
    set.up = {0, 0, 1};
    set.metres = 0.3048;
    set.crs = "EPSG:2992";
    set.bounds_min = {634000.125, 848000.5, 401.0625};
    set.bounds_max = {634060.75, 848063.5, 431.1};
    set.input_points = 1000;
    set.colors = true;
    set.oriented = true;
    set.noise = 0.0125;
    set.levels = {{0.0625, 0.03125, 0, 0, 0}, {0.125, 0.0625, 0, 0, 0}, {0.03125, 0.5, 0, 0, 0}};
    set.attributes = {{"intensity", PRO_TYPE_U16, 1, 0, 65535}, {"gps_time", PRO_TYPE_F64, 1, -1.5, 2.25e9}};
    set.sensors = {{634010.5, 848010.25, 1000, 1}, {}};
    set.settings = R"({"tile_splats":100})";
    set.tiles = {setTile(2, {0, 0, 0}, 80, 0.5), setTile(1, {0, 0, 0}, 60, 0.125), setTile(1, {1, 0, 0}, 50, 0),
                 setTile(1, {0, 1, 0}, 50, 0), setTile(1, {1, 1, 0}, 50, 0)};
    for (const TileCell cell : {TileCell{0, 0, 0}, TileCell{1, 0, 0}, TileCell{0, 1, 0}, TileCell{1, 1, 1}})
        set.tiles.push_back(setTile(0, cell, 100, 0));
    arrangeTiles(set);
    return set;
}

} // namespace pointrt::test

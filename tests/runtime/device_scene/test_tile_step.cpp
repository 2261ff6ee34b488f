// SPDX-License-Identifier: Apache-2.0
// Tiles come to a window in steps, coarse ones first.
#include <gtest/gtest.h>

#include "runtime/window/edit/tile_job.h"

namespace pointrt {
namespace {

constexpr std::uint64_t kMebibyte = 1 << 20;

SetTile tileAt(std::uint32_t level, std::int32_t cell, double error, std::uint64_t bytes) {
    SetTile tile;
    tile.level = level;
    tile.cell = {cell, 0, 0};
    tile.file = tileFileName(level, tile.cell);
    tile.error = error;
    tile.splats = tile.stored = 1;
    tile.bytes = bytes;
    return tile;
}

/// A root, two halves and four quarters, all of them wanted: the quarters take 160 MiB.
TileOrder orderOfFour() {
    OpenedSet set;
    set.folder = "row.proset";
    set.set.edge = 1;
    set.set.levels.resize(3);
    set.set.tiles = {tileAt(2, 0, 8, kMebibyte), tileAt(1, 0, 4, 10 * kMebibyte), tileAt(1, 1, 4, 10 * kMebibyte)};
    for (std::int32_t cell = 0; cell < 4; ++cell) set.set.tiles.push_back(tileAt(0, cell, 0, 40 * kMebibyte));
    arrangeTiles(set.set);
    set.children = childrenOf(set.set);
    CutView view;
    view.camera = {{-1, 0.5, 0.5}, {0, -1, 0}, {0, 0, 1}, {1, 0, 0}, 90, 0};
    view.height = 100;
    CutRequest request;
    request.views = {view};
    request.memory = 400 * kMebibyte;
    TileOrder order;
    order.resident = {tilePath(set, 0)};
    order.sets = {set};
    order.requests = {request};
    return order;
}

using Numbers = std::vector<std::uint32_t>;

TEST(TileStep, CoarseTilesComeFirst) {
    TileOrder order = orderOfFour();
    EXPECT_FALSE(chooseStep(order)); // 160 MiB for all, 90 with a quarter of the memory, 20 with a sixteenth
    EXPECT_EQ(order.sets[0].cut.tiles, (Numbers{1, 2}));
    for (const std::uint32_t tile : order.sets[0].cut.tiles) order.resident.insert(tilePath(order.sets[0], tile));
    EXPECT_FALSE(chooseStep(order)); // what a sixteenth holds is there: on to a quarter
    EXPECT_EQ(order.sets[0].cut.tiles, (Numbers{2, 3, 4}));
    for (const std::uint32_t tile : order.sets[0].cut.tiles) order.resident.insert(tilePath(order.sets[0], tile));
    EXPECT_TRUE(chooseStep(order));
    EXPECT_EQ(order.sets[0].cut.tiles, (Numbers{3, 4, 5, 6}));
}

TEST(TileStep, WhatIsBuiltIsToComeAsWell) {
    TileOrder order = orderOfFour();
    order.requests[0].splat_bytes = 30 * kMebibyte; // tiles here have a splat each
    EXPECT_EQ(chooseTiles(order), (4 * 40 + 4 * 30) * kMebibyte);
}

TEST(TileStep, WhatIsThereTakesNoStep) {
    TileOrder order = orderOfFour();
    for (std::uint32_t tile = 0; tile < 7; ++tile) order.resident.insert(tilePath(order.sets[0], tile));
    EXPECT_TRUE(chooseStep(order));
    EXPECT_EQ(order.sets[0].cut.tiles, (Numbers{3, 4, 5, 6}));
}

} // namespace
} // namespace pointrt

// SPDX-License-Identifier: Apache-2.0
// A window loads tiles in steps, coarse ones first.
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

/// A root, two halves and four quarters. The full cut is the quarters, which take 160 MiB.
TileLoadRequest requestOfFour() {
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
    CutRequest cut;
    cut.views = {view};
    cut.memory = 400 * kMebibyte;
    TileLoadRequest request;
    request.resident = {tilePath(set, 0)};
    request.sets = {set};
    request.requests = {cut};
    return request;
}

using TileStepNumbers = std::vector<std::uint32_t>;

TEST(TileStep, CoarseTiles_AreLoadedFirst) {
    TileLoadRequest request = requestOfFour();
    // all tiles take 160 MiB; the cut for a quarter of the memory takes 90, and for a sixteenth 20
    EXPECT_FALSE(chooseNextCut(request));
    EXPECT_EQ(request.sets[0].cut.tiles, (TileStepNumbers{1, 2}));
    for (const std::uint32_t tile : request.sets[0].cut.tiles) request.resident.insert(tilePath(request.sets[0], tile));
    EXPECT_FALSE(chooseNextCut(request)); // the cut for a sixteenth is resident: a quarter is next
    EXPECT_EQ(request.sets[0].cut.tiles, (TileStepNumbers{2, 3, 4}));
    for (const std::uint32_t tile : request.sets[0].cut.tiles) request.resident.insert(tilePath(request.sets[0], tile));
    EXPECT_TRUE(chooseNextCut(request));
    EXPECT_EQ(request.sets[0].cut.tiles, (TileStepNumbers{3, 4, 5, 6}));
}

TEST(TileStep, MissingBytes_IncludeIndicesToBuild) {
    TileLoadRequest request = requestOfFour();
    request.requests[0].splat_bytes = 30 * kMebibyte; // each tile has one splat
    EXPECT_EQ(chooseTiles(request), (4 * 40 + 4 * 30) * kMebibyte);
}

TEST(TileStep, ResidentTiles_TakeNoStep) {
    TileLoadRequest request = requestOfFour();
    for (std::uint32_t tile = 0; tile < 7; ++tile) request.resident.insert(tilePath(request.sets[0], tile));
    EXPECT_TRUE(chooseNextCut(request));
    EXPECT_EQ(request.sets[0].cut.tiles, (TileStepNumbers{3, 4, 5, 6}));
}

} // namespace
} // namespace pointrt

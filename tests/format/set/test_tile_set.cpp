// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <algorithm>
#include <fstream>
#include <iterator>
#include <random>

#include "small_set.h"
#include "tests/support/temporary_folder.h"

namespace pointrt {
namespace {

std::string fileText(const std::string& path) {
    std::ifstream in(path, std::ios::binary);
    return {std::istreambuf_iterator<char>(in), {}};
}

TEST(TileSet, RoundTripsToTheSameBytes) {
    const test::TemporaryFolder folder;
    writeTileSet(test::smallSet(), folder.path);
    const std::string bytes = fileText(folder.file("set.json"));
    EXPECT_EQ(bytes, fileText(std::string(POINTRT_SET_GOLDEN) + "/set.json"));
    const TileSet set = readTileSet(folder.path);
    writeTileSet(set, folder.path);
    EXPECT_EQ(fileText(folder.file("set.json")), bytes);
    EXPECT_EQ(set.crs, "EPSG:2992");
    EXPECT_EQ(set.splats, 550u);
    ASSERT_EQ(set.tiles.size(), 9u);
    EXPECT_EQ(set.tiles[0].checksum, 0xfedcba9876543210u + 8192 + 16 * 90);
    EXPECT_EQ(set.tiles[8].cell, (TileCell{1, 1, 1}));
}

TEST(TileSet, SaysWhetherTilesHoldGaussians) {
    const test::TemporaryFolder folder;
    TileSet set = test::smallSet();
    set.gaussians = true;
    writeTileSet(set, folder.path);
    EXPECT_TRUE(readTileSet(folder.path).gaussians);
    set.gaussians = false;
    writeTileSet(set, folder.path);
    EXPECT_FALSE(readTileSet(folder.path).gaussians);
}

TEST(TileSet, MayHaveThousandsOfTiles) {
    TileSet set;
    set.edge = 1;
    set.levels.assign(6, {0.0625, 0.03125, 0, 0, 0});
    for (std::uint32_t level = 0; level < 6; ++level)
        for (std::int32_t x = 0; x < 32 >> level; ++x)
            for (std::int32_t y = 0; y < 32 >> level; ++y)
                for (std::int32_t z = 0; z < 32 >> level; ++z)
                    set.tiles.push_back(test::setTile(level, {x, y, z}, 7, 0.1 * level));
    arrangeTiles(set);
    const test::TemporaryFolder folder;
    writeTileSet(set, folder.path);
    const TileSet read = readTileSet(folder.path);
    EXPECT_EQ(read.tiles.size(), 37449u); // 8^0 + ... + 8^5
    EXPECT_EQ(read.splats, 7u * 32768);
    EXPECT_EQ(read.tiles.back().cell, (TileCell{31, 31, 31}));
    for (const auto& children : childrenOf(read)) EXPECT_TRUE(children.empty() || children.size() == 8);
}

TEST(TileSet, ChildrenAreAdjacentInTheOrderOfParents) {
    const TileSet set = test::smallSet();
    const auto children = childrenOf(set);
    EXPECT_EQ(children[0], (std::vector<std::uint32_t>{1, 2, 3, 4}));
    EXPECT_EQ(children[1], (std::vector<std::uint32_t>{5, 6, 7, 8}));
    for (std::size_t i = 2; i < children.size(); ++i) EXPECT_TRUE(children[i].empty());
    EXPECT_EQ(findTile(set, 1, {1, 1, 0}), 4u);
    EXPECT_FALSE(findTile(set, 1, {1, 1, 1}).has_value());
    EXPECT_FALSE(findTile(set, 3, {0, 0, 0}).has_value());
}

/// Interleaves the bits, as in SPEC.md.
bool comesFirst(const TileCell& a, const TileCell& b) {
    for (int bit = 31; bit >= 0; --bit)
        for (const std::size_t axis : {2, 1, 0}) {
            const auto x = static_cast<std::uint32_t>(a[axis]) ^ 0x80000000u;
            const auto y = static_cast<std::uint32_t>(b[axis]) ^ 0x80000000u;
            if ((x ^ y) >> bit & 1) return (y >> bit & 1) != 0;
        }
    return false;
}

TEST(TileSet, OrderIsMortonOrderOfSignedCells) {
    std::mt19937 random(1);
    const auto number = [&] { return static_cast<std::int32_t>(random()) >> (random() % 32); };
    for (int i = 0; i < 100000; ++i) {
        const SetTile a = test::setTile(0, {number(), number(), number()}, 1, 0);
        const SetTile b = test::setTile(0, {number(), number(), number()}, 1, 0);
        ASSERT_EQ(isTileBefore(a, b), comesFirst(a.cell, b.cell));
        ASSERT_FALSE(isTileBefore(a, a));
    }
}

TEST(TileSet, CoresOfNeighboursMeetAndCubesAreTwiceAsLarge) {
    TileSet set = test::smallSet();
    set.edge = 0.3; // no corner is exact
    const TileBox core = coreOf(set, 1, {2, -1, 7});
    EXPECT_EQ(core.high[0], coreOf(set, 1, {3, -1, 7}).low[0]);
    EXPECT_EQ(core.low[1], coreOf(set, 1, {2, -2, 7}).high[1]);
    EXPECT_EQ(core.high[2], coreOf(set, 0, {4, -2, 16}).low[2]);
    const TileCube cube = cubeOf(test::smallSet(), test::setTile(1, {1, 0, 1}, 1, 0));
    EXPECT_EQ(cube.scale, 64);
    EXPECT_EQ(cube.origin, (std::array<double, 3>{634016, 847984, 416}));
    EXPECT_EQ(parentOf({-1, 5, -4}), (TileCell{-1, 2, -2}));
}

TEST(TileSet, IsRecognizedByNameOrFile) {
    const test::TemporaryFolder folder;
    EXPECT_TRUE(isTileSet("a/b.proset"));
    EXPECT_TRUE(isTileSet("a/b.proset/"));
    EXPECT_FALSE(isTileSet(folder.path));
    folder.write("set.json", "{}");
    EXPECT_TRUE(isTileSet(folder.path));
}

} // namespace
} // namespace pointrt

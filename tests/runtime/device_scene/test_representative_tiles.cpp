// SPDX-License-Identifier: Apache-2.0
#include "runtime/device_scene/representative_tiles.h"

#include <gtest/gtest.h>

namespace pointrt {
namespace {

SetTile tileAt(std::uint32_t level, std::int32_t cell, std::uint64_t splats, double error) {
    SetTile tile;
    tile.level = level;
    tile.cell = {cell, 0, 0};
    tile.splats = tile.stored = splats;
    tile.error = error;
    return tile;
}

/// 0: the root; 1 and 2: its halves, the right one an original tile; 3 and 4: quarters.
TileSet uneven() {
    TileSet set;
    set.edge = 1;
    set.levels.resize(3);
    set.tiles = {tileAt(2, 0, 10, 0.4), tileAt(1, 0, 20, 0.2), tileAt(1, 1, 50, 0), tileAt(0, 0, 30, 0),
                 tileAt(0, 1, 40, 0)};
    arrangeTiles(set);
    return set;
}

using Shares = std::vector<std::pair<std::uint32_t, std::uint64_t>>;

Shares sharesOf(const TileSet& set, std::size_t most) {
    Shares shares;
    for (const TileShare& share : representativeTiles(set, childrenOf(set), most))
        shares.emplace_back(share.tile, share.originals);
    return shares;
}

TEST(RepresentativeTiles, SmallSets_AreOriginalTiles) {
    EXPECT_EQ(sharesOf(uneven(), 120), (Shares{{2, 50}, {3, 30}, {4, 40}}));
    EXPECT_EQ(sharesOf(uneven(), 1000), (Shares{{2, 50}, {3, 30}, {4, 40}}));
}

TEST(RepresentativeTiles, LargeSets_AreCoarser) {
    EXPECT_EQ(sharesOf(uneven(), 119), (Shares{{1, 70}, {2, 50}}));
    EXPECT_EQ(sharesOf(uneven(), 70), (Shares{{1, 70}, {2, 50}}));
    EXPECT_EQ(sharesOf(uneven(), 69), (Shares{{0, 120}}));
    EXPECT_EQ(sharesOf(uneven(), 0), (Shares{{0, 120}}));
    TileSet repeated = uneven();
    repeated.tiles[3].stored += 5;
    EXPECT_EQ(sharesOf(repeated, 120), (Shares{{1, 70}, {2, 50}}));
}

TEST(RepresentativeTiles, Refinement_TakesTheLargestShareFirst) {
    TileSet set;
    set.edge = 1;
    set.levels.resize(3);
    set.tiles = {tileAt(2, 0, 10, 0.4), tileAt(1, 0, 20, 0.2), tileAt(1, 1, 5, 0.2), tileAt(0, 0, 30, 0),
                 tileAt(0, 1, 40, 0),   tileAt(0, 2, 45, 0),   tileAt(0, 3, 45, 0)};
    arrangeTiles(set);
    EXPECT_EQ(sharesOf(set, 115), (Shares{{1, 70}, {5, 45}, {6, 45}}));
}

} // namespace
} // namespace pointrt

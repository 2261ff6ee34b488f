// SPDX-License-Identifier: Apache-2.0
#include "preprocess/tiles/tile_tree.h"

#include <gtest/gtest.h>

#include "format/base/error.h"

namespace pointrt {
namespace {

/// A square of four cells of level 1, of which the last is split in four of level 0.
std::vector<TileKey> mixedOriginals() {
    return {{1, {0, 0, 0}}, {1, {1, 0, 0}}, {1, {0, 1, 0}}, {0, {2, 2, 0}},
            {0, {3, 2, 0}}, {0, {2, 3, 0}}, {0, {3, 3, 0}}};
}

TEST(TileTree, ParentsUpToOneRoot) {
    const TileTree tree(mixedOriginals());
    ASSERT_EQ(tree.tiles().size(), 9u); // with the split one and the root
    EXPECT_EQ(tree.root(), (TileKey{2, {0, 0, 0}}));
    EXPECT_FALSE(tree.isOriginal(tree.root()));
    EXPECT_TRUE(tree.has({1, {1, 1, 0}}));
    EXPECT_FALSE(tree.isOriginal({1, {1, 1, 0}}));
    EXPECT_EQ(tree.childrenOf({1, {1, 1, 0}}).size(), 4u);
    EXPECT_EQ(tree.childrenOf(tree.root()).size(), 4u);
    EXPECT_TRUE(tree.childrenOf({1, {0, 0, 0}}).empty());
}

TEST(TileTree, OriginalNeighborsAreExistingTiles) {
    const TileTree tree(mixedOriginals());
    // the fine tiles at its corner, and its upper and right neighbours
    const std::vector<TileKey> around_corner = tree.neighborsOf({1, {0, 0, 0}});
    EXPECT_EQ(around_corner, (std::vector<TileKey>{{1, {1, 0, 0}}, {1, {0, 1, 0}}, {0, {2, 2, 0}}}));
    EXPECT_EQ(tree.neighborsOf({0, {2, 2, 0}}).size(), 6u); // three coarse ones and its three siblings
    EXPECT_EQ(tree.neighborsOf({0, {3, 3, 0}}).size(), 3u); // no coarse neighbour
}

TEST(TileTree, MergedNeighborsAreThoseOfTheirLevel) {
    const TileTree tree(mixedOriginals());
    EXPECT_EQ(tree.neighborsOf({1, {1, 1, 0}}).size(), 3u);
    EXPECT_TRUE(tree.neighborsOf(tree.root()).empty());
}

TEST(TileTree, FindsTheTileOfAPosition) {
    const TileTree tree(mixedOriginals());
    const TileKey tile{1, {1, 0, 0}};
    EXPECT_EQ(tree.originalAt(tile, {5, 5, 5}), tile);
    EXPECT_EQ(tree.originalAt(tile, {-1, 5, 5}), (TileKey{1, {0, 0, 0}}));
    EXPECT_EQ(tree.originalAt(tile, {kCoreSteps - 1, kCoreSteps, 5}), (TileKey{0, {3, 2, 0}}));
    EXPECT_EQ(tree.originalAt({0, {2, 2, 0}}, {5, -1, 5}), tile);
    EXPECT_FALSE(tree.originalAt(tile, {5, -1, 5}).has_value());
    EXPECT_FALSE(tree.originalAt(tile, {5, kCoreSteps, kCoreSteps / 2}).has_value()); // over the fine ones
}

TEST(TileTree, OneTileIsItsOwnRoot) {
    const TileTree tree(std::vector<TileKey>{{3, {1, 2, 3}}});
    EXPECT_EQ(tree.tiles().size(), 1u);
    EXPECT_TRUE(tree.isOriginal(tree.root()));
}

TEST(TileTree, NegativeCellsHaveNoCommonAncestorWithOthers) {
    const std::vector<TileKey> both_sides{{0, {-1, 0, 0}}, {0, {0, 0, 0}}};
    EXPECT_THROW(TileTree{both_sides}, Error);
}

} // namespace
} // namespace pointrt

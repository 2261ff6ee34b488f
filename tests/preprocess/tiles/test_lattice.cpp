// SPDX-License-Identifier: Apache-2.0
#include "preprocess/tiles/lattice.h"

#include <gtest/gtest.h>

#include <random>

namespace pointrt {
namespace {

TileSet utmLattice() {
    TileSet set;
    set.lattice_origin = {637000, 851000, 400};
    set.edge = 32;
    return set;
}

TEST(Lattice, CodesOfACoreAreItsSteps) {
    const TileSet set = utmLattice();
    const TileKey tile{1, {2, 0, 1}}; // 64 wide, from 637128, 851000, 464
    EXPECT_EQ(codeOf(set, tile, {637128, 851000, 464}), (PositionCode{0, 0, 0}));
    EXPECT_EQ(codeOf(set, tile, {637160, 851016, 480}), (PositionCode{kCoreSteps / 2, kCoreSteps / 4, kCoreSteps / 4}));
    EXPECT_TRUE(isInCore({0, kCoreSteps - 1, 5}));
    EXPECT_FALSE(isInCore({0, kCoreSteps, 5}));
    EXPECT_FALSE(isInCore({-1, 0, 5}));
    EXPECT_TRUE(isInCube({-kRimSteps, kCoreSteps + kRimSteps - 1, 0}));
    EXPECT_FALSE(isInCube({0, 0, -kRimSteps - 1}));
}

TEST(Lattice, PositionsAreTheMiddlesOfTheirSteps) {
    const TileSet set = utmLattice();
    const TileKey tile{0, {3, 1, 0}};
    const double step = 32.0 / kCoreSteps;
    const Vec3d position = positionOf(set, tile, {0, -1, kCoreSteps});
    EXPECT_EQ(position.x(), 637096 + step / 2);
    EXPECT_EQ(position.y(), 851032 - step / 2);
    EXPECT_EQ(position.z(), 432 + step / 2);
    EXPECT_EQ(codeOf(set, tile, position), (PositionCode{0, -1, kCoreSteps}));
}

TEST(Lattice, NeighborsCodeTheSamePosition) {
    const TileSet set = utmLattice();
    std::mt19937 random(1);
    std::uniform_int_distribution<std::int32_t> steps(0, kCoreSteps - 1);
    const TileKey from{0, {3, 1, 0}}, to{0, {4, 0, 0}};
    int seen = 0;
    for (int i = 0; i < 10000; ++i) {
        const PositionCode code{steps(random), steps(random), steps(random)};
        const auto there = codeIn(to, from, code);
        const bool reaches = code[0] >= kRimSteps && code[1] < kRimSteps;
        ASSERT_EQ(there.has_value(), reaches);
        if (!there) continue;
        ++seen;
        EXPECT_EQ(positionOf(set, to, *there), positionOf(set, from, code));
    }
    EXPECT_GT(seen, 2000); // a quarter
}

TEST(Lattice, OtherLevelsHoldTheMiddleOfTheStep) {
    const TileKey fine{0, {2, 0, 0}}, coarse{1, {0, 0, 0}}; // coarse ends where fine begins
    EXPECT_EQ(codeIn(coarse, fine, {10, 11, 0}), (PositionCode{kCoreSteps + 5, 5, 0}));
    EXPECT_EQ(codeIn(fine, coarse, {kCoreSteps - 1, 7, 0}), (PositionCode{-1, 15, 1}));
    EXPECT_EQ(codeIn(fine, TileKey{2, {0, 0, 0}}, {kCoreSteps / 2, 0, 1}), (PositionCode{2, 2, 6}));
    EXPECT_FALSE(codeIn(fine, coarse, {0, 0, 0}).has_value());
}

} // namespace
} // namespace pointrt

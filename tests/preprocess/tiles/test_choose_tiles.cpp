// SPDX-License-Identifier: Apache-2.0
// Counting points, and dividing space into tiles.
#include "preprocess/tiles/choose_tiles.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <numeric>

#include "format/base/error.h"
#include "preprocess/cloud/split_mix.h"
#include "preprocess/tiles/tile_finder.h"
#include "tests/support/says.h"

namespace pointrt {
namespace {

std::vector<Vec3d> scattered(std::size_t count, const Vec3d& low, const Vec3d& size) {
    std::vector<Vec3d> positions;
    for (std::size_t i = 0; i < count; ++i)
        positions.push_back(low + size.cwiseProduct(Vec3d(unitShare(mixBits(3 * i)), unitShare(mixBits(3 * i + 1)),
                                                          unitShare(mixBits(3 * i + 2)))));
    return positions;
}

TEST(CountGrid, CountsEveryPointInItsCellHoweverOftenCellsGrew) {
    const std::vector<Vec3d> positions = scattered(40'000, {-7, 4'000'000, -3}, {40, 30, 20});
    CountGrid grid(500);
    std::size_t first_ones = 0;
    for (std::size_t from = 0; from < positions.size(); from += 1000)
        grid.add({positions.begin() + std::ptrdiff_t(from), positions.begin() + std::ptrdiff_t(from + 1000)},
                 [&](std::size_t) { ++first_ones; });
    EXPECT_LE(grid.cellCount(), 500u);
    EXPECT_GT(grid.cellCount(), 500u / 8);
    EXPECT_GE(first_ones, grid.cellCount());
    std::map<GridCell, std::uint64_t> expected, counted;
    for (const Vec3d& position : positions) {
        GridCell cell;
        for (int axis = 0; axis < 3; ++axis)
            cell[std::size_t(axis)] = static_cast<std::int64_t>(std::floor(position[axis] / grid.edge()));
        ++expected[cell];
    }
    for (const CountedCell& each : grid.cells()) counted[each.cell] = each.points;
    EXPECT_EQ(counted, expected);
}

/// A plane of 64 x 64 cells of 10 points each.
std::vector<CountedCell> plain() {
    std::vector<CountedCell> cells;
    for (std::int64_t x = 0; x < 64; ++x)
        for (std::int64_t y = 0; y < 64; ++y) cells.push_back({{x - 10, y + 1000, 5}, 10});
    return cells;
}

TEST(ChooseTiles, APlaneIsSplitIntoEqualSquares) {
    SetPlan plan;
    TileChoice choice;
    choice.points_per_tile = 2560; // a sixteenth of all points
    chooseTiles(plain(), 0.5, choice, plan);
    EXPECT_EQ(plan.points, 40'960u);
    EXPECT_EQ(plan.tiles.size(), 16u);
    EXPECT_EQ(plan.edge, 8);
    EXPECT_EQ(plan.levels, 3u);
    EXPECT_EQ(plan.lattice_origin, Vec3d(-5, 500, 2.5));
    for (const PlanTile& tile : plan.tiles) {
        EXPECT_EQ(tile.points, 2560u);
        EXPECT_EQ(tile.level, 0u);
        EXPECT_NEAR(tile.spacing, 0.5 / std::sqrt(10.0), 1e-12);
    }
    EXPECT_EQ(plan.first_tile_of_block, (std::vector<std::uint32_t>{0, 4, 8, 12, 16}));
}

/// A plane of 64 x 64 points, four cells apart: each in a separate cell.
TEST(ChooseTiles, PointsFartherApartThanCellsAreWideHaveTheirOwnSpacing) {
    std::vector<CountedCell> cells;
    for (std::int64_t x = 0; x < 64; ++x)
        for (std::int64_t y = 0; y < 64; ++y) cells.push_back({{4 * x, 4 * y, 5}, 1});
    SetPlan plan;
    TileChoice choice;
    choice.points_per_tile = 256;
    chooseTiles(cells, 0.5, choice, plan);
    EXPECT_EQ(plan.tiles.size(), 16u);
    for (const PlanTile& tile : plan.tiles) EXPECT_NEAR(tile.spacing, 4 * 0.5, 1e-12);
}

TEST(ChooseTiles, DenseAreasAreSplitFurther) {
    std::vector<CountedCell> cells = plain();
    for (CountedCell& each : cells)
        if (each.cell[0] < 6 && each.cell[1] < 1016) each.points = 40; // the lowest of the 16 squares
    SetPlan plan;
    TileChoice choice;
    choice.points_per_tile = 2560;
    chooseTiles(cells, 0.5, choice, plan);
    ASSERT_EQ(plan.tiles.size(), 19u);
    EXPECT_EQ(plan.edge, 4);
    EXPECT_EQ(std::count_if(plan.tiles.begin(), plan.tiles.end(), [](const PlanTile& t) { return t.level == 0; }), 4);
    for (const PlanTile& tile : plan.tiles) EXPECT_EQ(tile.points, 2560u);
}

TEST(ChooseTiles, AFewStraysFarAwayMakeNoTiles) {
    std::vector<CountedCell> cells = plain();
    cells.push_back({{4'000'000, 1000, 5}, 3});
    SetPlan plan;
    TileChoice choice;
    choice.points_per_tile = 2560;
    chooseTiles(cells, 0.5, choice, plan);
    EXPECT_EQ(plan.points_stray, 3u);
    EXPECT_EQ(plan.levels, 3u);
    EXPECT_EQ(plan.tiles.size(), 16u);
    choice.leaves_out_strays = false;
    chooseTiles(cells, 0.5, choice, plan);
    EXPECT_EQ(plan.points_stray, 0u);
    EXPECT_GT(plan.levels, 15u);
    EXPECT_EQ(std::accumulate(plan.tiles.begin(), plan.tiles.end(), std::uint64_t{0},
                              [](std::uint64_t sum, const PlanTile& tile) { return sum + tile.points; }),
              40'963u);
}

TEST(ChooseTiles, TooManyPointsForTheMemoryAreRefused) {
    SetPlan plan;
    TileChoice choice;
    choice.points_per_tile = choice.most_points = 50;
    std::vector<CountedCell> cells = plain();
    chooseTiles(cells, 1, choice, plan);
    for (const PlanTile& tile : plan.tiles) EXPECT_LE(tile.points, 50u);
    cells[7].points = 51;
    try {
        chooseTiles(cells, 1, choice, plan);
        FAIL();
    } catch (const Error& error) {
        EXPECT_EQ(error.code, ExitCode::kCannotRun);
        EXPECT_SAYS(error.what(), "51 points *--max-memory");
    }
}

TEST(TileFinder, CoresAreHalfOpenToTheLastBit) {
    SetPlan plan;
    TileChoice choice;
    choice.points_per_tile = 2560;
    chooseTiles(plain(), 0.5, choice, plan);
    const TileFinder finder(plan);
    for (std::uint32_t i = 0; i < plan.tiles.size(); ++i) {
        const PlanBox core = coreOf(plan, plan.tiles[i]);
        const Vec3d inside = core.min().unaryExpr([](double v) { return std::nextafter(v, INFINITY); });
        const Vec3d last = core.max().unaryExpr([](double v) { return std::nextafter(v, -INFINITY); });
        EXPECT_EQ(finder.find(core.min()), i);
        EXPECT_EQ(finder.find(inside), i);
        EXPECT_EQ(finder.find(last), i);
        EXPECT_NE(finder.find(core.max()), i);
        EXPECT_NE(finder.find(core.min() - Vec3d(1e-9, 0, 0)), i);
    }
    EXPECT_EQ(finder.find({1e300, 0, 0}), TileFinder::kNone);
    // subtracting the origin would round it into the next core
    EXPECT_EQ(finder.find({-1e-300, 501, 3}), finder.find({-1, 501, 3}));
}

} // namespace
} // namespace pointrt

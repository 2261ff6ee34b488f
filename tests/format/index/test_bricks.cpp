// SPDX-License-Identifier: Apache-2.0
// Bricks of small scenes list every disc in every cell that it crosses, by exact intersections of discs and cells.
#include "tests/format/index/brick_scene.h"

namespace pointrt {
namespace {

using namespace test;
using namespace test::bricks;

TEST(Bricks, OneDiscHasOneCell) {
    const Loaded loaded = load(sceneOf({disc({0.375, 0.375, 0.375}, {0.36, 0.48, 0.8}, 0.05)}));
    ASSERT_EQ(loaded.grid.words, (Words{0}));
    EXPECT_EQ(loaded.bricks.corners, (std::vector<Corner>{{0, 0, 0}}));
    EXPECT_EQ(loaded.bricks.words[1 + 4 + 16], 0u);
    EXPECT_EQ(std::count_if(loaded.bricks.words.begin(), loaded.bricks.words.end(), isFilled), 1);
    EXPECT_EQ(loaded.bricks.listed, (Words{0, 0}));
    EXPECT_EQ(loaded.bricks.blending, (Words{0}));
    EXPECT_EQ(firstOf(loaded, 0), 0u);
    EXPECT_EQ(countOf(loaded, 0), 1u);
}

/// Rays look one step ahead: cells list a disc just behind their border, but not one further away.
TEST(Bricks, ListDiscsJustBehindTheBorder) {
    for (const double sign : {-1.0, 1.0})
        for (const double steps : {0.5, 100.5, 1500.5}) {
            const double z = 0.5 + sign * steps * kStep;
            // two more discs, in front and behind, so that both cells have lists
            const Loaded loaded =
                load(sceneOf({disc({0.4, 0.4, z}, {0, 0, 1}, 0.05), disc({0.4, 0.4, 0.4}, {0, 0, 1}, 0.01),
                              disc({0.4, 0.4, 0.6}, {0, 0, 1}, 0.01)}));
            const auto other = cellAt(loaded, {0.4, 0.4, 0.5 - sign * 0.01});
            ASSERT_TRUE(other);
            const bool near = steps * kStep < 1e-3 / 4; // the slack is 1/1000 of a cell's edge, which is 1/4 here
            EXPECT_EQ(contains(listOf(loaded, *other), 0), near) << sign * steps;
            EXPECT_EQ(contains(blendingOf(loaded, *other), 0), !near) << sign * steps;
        }
}

TEST(Bricks, ListAllCrossingDiscsOfAnEvenScene) {
    const Loaded loaded = loadSplats(sheet(32, 0.7, {0.5, 0.5, 0.5}, 0.8));
    EXPECT_FALSE(loaded.grid.uneven);
    expectSound(loaded);
}

TEST(Bricks, ListAllCrossingDiscsOfAHeap) { expectSound(loadSplats(heap(700, 1, {0.1, 0.2, 0.05}, 0.8, 0.06))); }

TEST(Bricks, ListAllCrossingDiscsIfLeavesAreAboveTheGrid) {
    std::vector<pro_splat> splats =
        join(sheet(40, 0.1, {0.2, 0.2, 0.2}, 0.8), heap(40, 2, {0.05, 0.05, 0.5}, 0.9, 0.15));
    Loaded loaded = loadSplats(splats);
    std::uint32_t highest = 0;
    const pro_view view = loaded.scene.view();
    forNodes({view.nodes, loaded.scene.info.node_count}, PRO_MAX_DEPTH,
             [&](std::uint32_t, const Corner&, std::uint32_t shift) { highest = std::max(highest, shift); });
    EXPECT_GE(highest, loaded.grid.shift + 2);
    expectSound(loaded);
}

TEST(Bricks, ListAllCrossingDiscsIfLeavesAreBelowTheGrid) {
    const Loaded loaded =
        loadSplats(join(sheet(40, 0.8, {0.5, 0.5, 0.5}, 0.8), heap(600, 3, {0.3, 0.6, 0.45}, 0.0015, 1e-4)));
    EXPECT_TRUE(loaded.grid.uneven);
    EXPECT_GT(loaded.bricks.words.size(), loaded.bricks.corners.size() * PRO_BRICK_WORDS); // groups of halves
    expectSound(loaded);
}

TEST(Bricks, UseACoarserGridBeyondTheLimits) {
    const std::vector<pro_splat> splats = sheet(40, 0.7, {0.5, 0.5, 0.5}, 0.8);
    const Loaded free = loadSplats(splats);
    BrickLimits limits;
    limits.cells = free.bricks.slabs.size() / 6; // one level less has a quarter of the cells, or slightly more
    const Loaded limited = loadSplats(splats, limits);
    EXPECT_EQ(limited.grid.shift, free.grid.shift + 2);
    EXPECT_LE(limited.bricks.slabs.size(), limits.cells);
    expectSound(limited);

    limits = {};
    limits.listed = listedBy(free.bricks) - 4;
    const Loaded shorter = loadSplats(splats, limits);
    EXPECT_EQ(shorter.grid.shift, free.grid.shift + 1);
    EXPECT_LE(listedBy(shorter.bricks), limits.listed);
    expectSound(shorter);
}

TEST(Bricks, ProgressNeverDecreases) {
    Scene scene = sceneOf(sheet(120, 0.7, {0.5, 0.5, 0.5}, 0.8), kOptions);
    const pro_view view = scene.view();
    EntryGrid grid = frameEntryGrid(scene.info, view);
    const std::uint32_t shift = grid.shift;
    std::vector<double> shares;
    IndexOptions options;
    options.progress = [&](double share) { shares.push_back(share); };
    options.limits.listed = listedBy(buildBricks(scene.info, view, grid, options)) - 4;
    EXPECT_EQ(grid.shift, shift);
    shares.clear();
    buildBricks(scene.info, view, grid, options);
    EXPECT_EQ(grid.shift, shift + 1);
    EXPECT_GT(shares.size(), 2u);
    EXPECT_TRUE(std::is_sorted(shares.begin(), shares.end()));
}

TEST(Bricks, RefuseScenesBeyondTheLimitsOfAnyGrid) {
    BrickLimits limits;
    limits.cells = 7; // a brick counts as 8
    try {
        loadSplats(sheet(8, 0.5, {0.5, 0.5, 0.5}, 0.8), limits);
        FAIL() << "no error";
    } catch (const Error& error) {
        EXPECT_EQ(error.code, ExitCode::kCannotRun);
    }
}

/// Normals in files are at least 3.5e-4 away from z: discs 60 cells wide dip below a border by several times the cells'
/// slack.
TEST(Bricks, ListHugeDiscsNearlyAlongTheCells) {
    std::vector<pro_splat> splats = sheet(40, 0.06, {0.5, 0.5, 0.5}, 0.8);
    for (int k = 0; k < 8; ++k) {
        const double tilt = k < 4 ? 0 : 5e-4 * (k - 3), off = 2e-5 * (k % 4 - 1.5);
        splats.push_back(disc({0.51, 0.49 + 0.002 * k, 0.5 + off}, {tilt, 0, 1}, 0.24));
        splats.push_back(disc({0.51, 0.5 + off, 0.49 + 0.002 * k}, {0, -1, tilt}, 0.24));
    }
    const Loaded loaded = loadSplats(splats);
    EXPECT_GT(0.24, 25 * gridCube(loaded, 0).edge / PRO_BRICK_SIDE);
    expectSound(loaded);
}

} // namespace
} // namespace pointrt

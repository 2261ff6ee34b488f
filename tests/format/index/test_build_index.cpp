// SPDX-License-Identifier: Apache-2.0
// The tracing index is the same for any number of threads and passes the checks of the format.
#include "format/index/build_index.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "tests/format/file_bytes.h"
#include "tests/format/scene_builder.h"
#include "tests/support/temporary_folder.h"

namespace pointrt {
namespace {

using test::Scene;

/// Splats on a sheet, and in a corner of it so many that cells are halved.
Scene crowdedScene() {
    std::mt19937 random(3);
    std::uniform_real_distribution<float> unit(0.05f, 0.95f);
    std::vector<pro_splat> splats;
    for (int k = 0; k < 3000; ++k) splats.push_back({{unit(random), unit(random), 0.5f}, {0, 0, 1}, 0.02f, {}, 0});
    for (int k = 0; k < 6000; ++k) {
        const float x = 0.3f + 0.01f * unit(random), y = 0.3f + 0.01f * unit(random);
        splats.push_back({{x, y, 0.5f + 0.002f * std::sin(900 * x)}, {0, 0, 1}, 0.0002f, {}, 0});
    }
    return test::sceneOf(splats);
}

void expectSame(const TracingIndex& a, const TracingIndex& b) {
    EXPECT_EQ(a.grid.words, b.grid.words);
    EXPECT_EQ(a.grid.shift, b.grid.shift);
    EXPECT_EQ(a.bricks.words, b.bricks.words);
    EXPECT_EQ(a.bricks.cells, b.bricks.cells);
    EXPECT_EQ(a.bricks.slabs, b.bricks.slabs);
    EXPECT_EQ(a.bricks.near, b.bricks.near);
    EXPECT_EQ(a.bricks.listed, b.bricks.listed);
    EXPECT_EQ(a.bricks.blending, b.bricks.blending);
}

TEST(BuildIndex, TheSameForAnyNumberOfThreads) {
    Scene scene = crowdedScene();
    const pro_view view = scene.view();
    const TracingIndex one = buildTracingIndex(scene.info, view, {1, {}});
    ASSERT_GT(indexView(one).group_count, 0u) << "the test must cover groups";
    for (const std::size_t threads : {2u, 5u, 0u}) expectSame(one, buildTracingIndex(scene.info, view, {threads, {}}));
}

/// Discs in two planes: all numbers are exact, so that the scene is the same on any machine.
Scene exactScene() {
    std::vector<pro_splat> splats;
    for (unsigned k = 0; k < 3000; ++k) {
        const float x = static_cast<float>(k * 7919 % 1000) / 1024, y = static_cast<float>(k * 104729 % 1000) / 1024;
        splats.push_back({{x, y, 0.5f}, {0, 0, 1}, 0.02f, {}, 0});
        splats.push_back({{0.25f, x / 16, y / 16}, {1, 0, 0}, 0.001f, {}, 0}); // crowded
    }
    return test::sceneOf(splats);
}

/// If this fails, increase kIndexVersion: cached indices of the old builder must not be used.
TEST(BuildIndex, OutputMatchesItsVersion) {
    Scene scene = exactScene();
    const TracingIndex index = buildTracingIndex(scene.info, scene.view());
    std::uint64_t sum = 0;
    for (const Words* words : {&index.grid.words, &index.bricks.words, &index.bricks.cells, &index.bricks.slabs,
                               &index.bricks.near, &index.bricks.listed, &index.bricks.blending})
        sum = XXH3_64bits_withSeed(words->data(), words->size() * sizeof(std::uint32_t), sum);
    EXPECT_EQ(kIndexVersion, 1u);
    EXPECT_EQ(sum, 1731134349194401415u);
}

TEST(BuildIndex, PassesTheChecksAndReadsBack) {
    const test::TemporaryFolder folder;
    Scene scene = crowdedScene();
    const pro_view view = scene.view();
    const TracingIndex built = buildTracingIndex(scene.info, view);
    const pro_index index = indexView(built);
    writePro(folder.file("a.pro"), scene.info, view, &index);
    const test::Bytes bytes = test::readBytes(folder.file("a.pro"));
    EXPECT_TRUE(test::findingsOf(bytes).empty());
    EXPECT_EQ(test::openCopy(bytes).result, PRO_OK);
    const ProFile file(folder.file("a.pro"), PRO_OPEN_TRACE);
    ASSERT_NE(file.index(), nullptr);
    const pro_index& read = *file.index();
    EXPECT_EQ(read.shift, index.shift);
    EXPECT_EQ(read.uneven, 1u);
    EXPECT_EQ(read.group_count, index.group_count);
    ASSERT_EQ(read.near_count, index.near_count);
    ASSERT_EQ(read.blending_count, index.blending_count);
    EXPECT_TRUE(std::equal(built.bricks.words.begin(), built.bricks.words.end(), read.bricks));
    EXPECT_TRUE(std::equal(built.bricks.near.begin(), built.bricks.near.end(), read.near_splats));
    EXPECT_TRUE(std::equal(built.bricks.listed.begin(), built.bricks.listed.end(), read.listed));
    EXPECT_TRUE(std::equal(built.bricks.blending.begin(), built.bricks.blending.end(), read.blending));
    EXPECT_TRUE(file.nodes().empty());
}

TEST(BuildIndex, ReportsProgress) {
    Scene scene = crowdedScene();
    const pro_view view = scene.view();
    double last = 0;
    buildTracingIndex(scene.info, view, {2, [&](double share) {
                                             EXPECT_GT(share, last);
                                             last = share;
                                         }});
    EXPECT_EQ(last, 1);
}

} // namespace
} // namespace pointrt

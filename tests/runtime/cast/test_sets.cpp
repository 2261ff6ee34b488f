// SPDX-License-Identifier: Apache-2.0
// Rays through tile sets hit what they hit in one file of the same splats, for any memory limit.
#include <gtest/gtest.h>

#include <cstdio>
#include <filesystem>
#include <fstream>
#include <thread>

#include "format/set/open_tile.h"
#include "runtime/gpu/device.h"
#include "tests/runtime/rays/set_scenes.h"
#include "tests/support/hand_cut_set.h"
#include "tests/support/says.h"

namespace pointrt::test {
namespace {

constexpr std::size_t kRays = 100000;
/// Share of rays that may differ, at outlines, because positions are quantised in another cube.
constexpr std::size_t kAtRims = 10;

/// Created once and only read.
class RaysThroughSets : public testing::Test {
protected:
    static void SetUpTestSuite() { ball = new SphereInTiles; }
    static void TearDownTestSuite() {
        delete ball;
        ball = nullptr;
    }
    void TearDown() override { EXPECT_EQ(validationMessages(), messages_); }

    static std::vector<double> rays(std::size_t count = kRays, unsigned seed = 1) {
        return raysAround(ball->center, 1.5 * SphereInTiles::kRadius, count, seed);
    }
    TraceScene tiles(std::uint64_t memory = SceneOptions{}.memory) const {
        return TraceScene(device, {ball->tiles()}, {memory});
    }
    /// A memory limit for about this many tiles.
    static std::uint64_t roomFor(double tiles) {
        return static_cast<std::uint64_t>(tiles * static_cast<double>(ball->largestTile()));
    }

    static inline SphereInTiles* ball = nullptr;
    TraceDevice device;
    std::uint64_t messages_ = validationMessages();
};

/// Eight tiles around the point where they meet, and the same splats in one file, the root.
struct EightTiles {
    EightTiles() {
        const Splats splats = sphereSplats(20000, Vec3f(0, 0, 0), 1);
        radius = static_cast<double>(splats.radii[0]);
        set = writeHandCutSet(tiles(), {{-1.25, -1.25, -1.25}, 1.25, 2, 1, splats.radii[0]}, splats, splats);
        for (std::size_t i = 1; i < set.tiles.size(); ++i) largest = std::max(largest, set.tiles[i].bytes);
    }
    std::string tiles() const { return folder.file("eight.proset"); }
    std::string whole() const { return tilePath(tiles(), set.tiles[0]); }
    TemporaryFolder folder;
    TileSet set;
    double radius = 0;
    std::uint64_t largest = 0; ///< bytes of a file; an index built for it takes as much again
};

struct Others {
    std::size_t hits = 0, elsewhere = 0, blocked = 0;
};

Others othersOf(const EightTiles& eight, const std::vector<double>& rays, const SceneHits& whole,
                const SceneHits& found) {
    Others others;
    for (std::size_t i = 0; i < found.t_hit.size(); ++i) {
        const bool hit = std::isfinite(found.t_hit[i]);
        const double apart = std::abs(found.t_hit[i] - whole.t_hit[i]) * length(directionOf(rays, i));
        const bool same =
            hit ? apart < 0.02 * eight.radius : std::isinf(whole.t_hit[i]); // the discs of cells are quantised
        others.hits += hit;
        others.elsewhere += !same;
        others.blocked += found.occluded[i] != (hit ? 1 : 0);
        if (hit && same) {
            EXPECT_LT(length(found.position(i) - whole.position(i)), 0.02 * eight.radius) << i;
            // of two discs that a ray grazes, one may be hit on its back
            EXPECT_NEAR(std::abs(dot(found.normal(i), whole.normal(i))), 1, 0.01) << i;
            EXPECT_EQ(found.instance_ids[i], 0u);
        }
    }
    return others;
}

TEST_F(RaysThroughSets, MatchOneFile) {
    const EightTiles eight;
    ASSERT_EQ(eight.set.tiles.size(), 9u);
    const std::vector<double> all = raysAround({0, 0, 0}, 1.5, kRays, 1);
    const SceneHits whole = castBoth(TraceScene(device, {eight.whole()}), all);
    for (const std::uint64_t memory : {SceneOptions{}.memory, 2 * eight.largest}) {
        const TraceScene scene(device, {eight.tiles()}, {memory});
        const Others others = othersOf(eight, all, whole, castBoth(scene, all));
        std::printf("%zu rays, %zu hits, %zu elsewhere, %zu blocked otherwise, %llu loads\n", kRays, others.hits,
                    others.elsewhere, others.blocked, static_cast<unsigned long long>(scene.tileLoads()));
        EXPECT_GT(others.hits, kRays / 4);
        EXPECT_LT(others.hits, kRays - kRays / 8);
        EXPECT_LE(others.elsewhere, kAtRims);
        EXPECT_EQ(others.blocked, 0u);
        EXPECT_LE(scene.deviceBytes(), memory);
    }
}

TEST_F(RaysThroughSets, AreIdentical_ForAnyMemoryLimit) {
    const std::vector<double> all = rays(kRays, 2);
    const TraceScene held = tiles();
    const SceneHits expected = castBoth(held, all);
    EXPECT_EQ(held.tileLoads(), ball->originals());
    for (const double room : {1.0, 2.5}) {
        const TraceScene streamed = tiles(roomFor(room));
        EXPECT_EQ(streamed.tileLoads(), 0u);
        const SceneHits found = castBoth(streamed, all);
        EXPECT_EQ(found.t_hit, expected.t_hit);
        EXPECT_EQ(found.tile_ids, expected.tile_ids);
        EXPECT_EQ(found.splat_ids, expected.splat_ids);
        EXPECT_EQ(found.normals, expected.normals);
        EXPECT_EQ(found.occluded, expected.occluded);
        EXPECT_GT(streamed.tileLoads(), ball->originals()); // loaded for hits and again for occlusion
        EXPECT_LE(streamed.deviceBytes(), roomFor(room));
        std::printf("%.1f tiles: %llu loads\n", room, static_cast<unsigned long long>(streamed.tileLoads()));
    }
}

TEST_F(RaysThroughSets, Name_TheTileWhoseCoreHasTheHit) {
    const std::vector<double> all = rays(20000, 3);
    const SceneHits found = castBoth(tiles(), all);
    std::size_t hits = 0, away = 0;
    std::vector<std::size_t> of_tile(ball->set.tiles.size());
    for (std::size_t i = 0; i < found.t_hit.size(); ++i) {
        const bool hit = std::isfinite(found.t_hit[i]);
        ASSERT_EQ(hit, found.tile_ids[i] != kNoHit) << i;
        if (!hit) continue;
        ASSERT_LT(found.tile_ids[i], ball->set.tiles.size());
        const SetTile& tile = ball->set.tiles[found.tile_ids[i]];
        ASSERT_TRUE(tile.isOriginal());
        ASSERT_LT(found.splat_ids[i], tile.stored);
        const TileBox core = coreOf(ball->set, tile);
        const Vec3 at = found.position(i);
        const double p[3] = {at.x, at.y, at.z};
        double outside = 0;
        for (std::size_t axis = 0; axis < 3; ++axis)
            outside = std::max({outside, core.low[axis] - p[axis], p[axis] - core.high[axis]});
        // towards empty cells discs extend out of the core by a radius
        EXPECT_LE(outside, 2 * ball->splat_radius) << i;
        away += outside > 0.05 * ball->splat_radius;
        ++hits;
        ++of_tile[found.tile_ids[i]];
    }
    EXPECT_LT(away, hits / 50);
    for (std::uint32_t tile = 0; tile < of_tile.size(); ++tile)
        if (ball->set.tiles[tile].splats > 500 && ball->set.tiles[tile].isOriginal()) {
            EXPECT_GT(of_tile[tile], 10u) << tile;
        }
}

TEST_F(RaysThroughSets, LimitsAndRescaledRays_WorkAcrossTiles) {
    const double radius = SphereInTiles::kRadius;
    const TraceScene streamed = tiles(roomFor(1));
    std::vector<double> along;
    for (const double size : {1.0, 1e-200, 1e200})
        addRay(along, ball->center - 100 * Vec3{1, 0.01, 0.02}, size * Vec3{1, 0.01, 0.02});
    const SceneHits near = castBoth(streamed, along);
    for (std::size_t i = 0; i < 3; ++i) {
        const double size = along[6 * i + 3];
        EXPECT_NEAR(near.t_hit[i] * size, 100 - radius, 0.1) << i;
        const SceneHits far = castBoth(streamed,
                                       {along.begin() + 6 * static_cast<std::ptrdiff_t>(i),
                                        along.begin() + 6 * static_cast<std::ptrdiff_t>(i + 1)},
                                       {100 / size, 200 / size});
        EXPECT_NEAR(far.t_hit[0] * size, 100 + radius, 0.1) << i;
        EXPECT_EQ(far.occluded[0], 1);
        const SceneHits none = castBoth(streamed,
                                        {along.begin() + 6 * static_cast<std::ptrdiff_t>(i),
                                         along.begin() + 6 * static_cast<std::ptrdiff_t>(i + 1)},
                                        {80 / size, 120 / size});
        EXPECT_TRUE(std::isinf(none.t_hit[0]));
        EXPECT_EQ(none.occluded[0], 0);
    }
    std::vector<double> wrong = rays(5, 4);
    wrong[6 * 3 + 4] = std::nan("");
    std::vector<double> t(5);
    try {
        streamed.castRays(std::span<const double>(wrong), {}, {.t_hit = t});
        FAIL();
    } catch (const RayError& error) {
        EXPECT_EQ(error.ray, 3u);
    }
}

TEST_F(RaysThroughSets, Attributes_MatchTheHits) {
    const std::vector<double> all = rays(5000, 5);
    for (const double room : {1.0, 100.0}) {
        const TraceScene scene = tiles(roomFor(room));
        ASSERT_EQ(scene.attributes().size(), 1u);
        EXPECT_EQ(scene.attributes()[0].name, "number");
        const SceneHits found = castBoth(scene, all);
        std::vector<std::uint32_t> numbers(found.t_hit.size(), 7);
        scene.readAttribute("number", found.splat_ids, found.instance_ids, found.tile_ids,
                            std::as_writable_bytes(std::span(numbers)));
        for (std::size_t i = 0; i < numbers.size(); ++i) {
            if (std::isinf(found.t_hit[i])) {
                ASSERT_EQ(numbers[i], 0u);
                continue;
            }
            ASSERT_LT(length(found.position(i) - ball->points[numbers[i]]), 1.05 * ball->splat_radius) << i;
        }
        try {
            scene.readAttribute("number", found.splat_ids, found.instance_ids,
                                std::as_writable_bytes(std::span(numbers)));
            FAIL();
        } catch (const TraceError& error) {
            EXPECT_EQ(error.kind, TraceError::Kind::kBadUsage);
            EXPECT_SAYS(error.what(), "number: tile_ids ");
        }
    }
}

TEST_F(RaysThroughSets, FromSeveralThreads_AreIdentical) {
    const std::vector<double> all = rays(5000, 6);
    const TraceScene held = tiles(), streamed = tiles(roomFor(1));
    const SceneHits expected = castBoth(held, all);
    std::vector<int> right(4);
    {
        std::vector<std::jthread> threads;
        for (std::size_t k = 0; k < right.size(); ++k)
            threads.emplace_back([&, k] {
                const SceneHits found = castBoth(k % 2 == 0 ? held : streamed, all);
                right[k] = found.t_hit == expected.t_hit && found.tile_ids == expected.tile_ids &&
                           found.occluded == expected.occluded;
            });
    }
    EXPECT_EQ(right, std::vector<int>(4, 1));
}

TEST_F(RaysThroughSets, SetsAndFiles_CanBeCombined) {
    const std::vector<double> all = rays(20000, 7);
    const SceneHits alone = castBoth(tiles(), all);
    const TraceScene both(device, {ball->tiles(), ball->whole()}, {roomFor(2)});
    EXPECT_EQ(both.instanceCount(), 2u);
    EXPECT_TRUE(both.hasTiles());
    EXPECT_EQ(both.splatCount(), 2 * SphereInTiles::kSplats);
    EXPECT_TRUE(both.attributes().empty());
    const SceneHits found = castBoth(both, all);
    std::size_t others = 0;
    for (std::size_t i = 0; i < found.t_hit.size(); ++i) {
        others += std::isfinite(found.t_hit[i]) != std::isfinite(alone.t_hit[i]);
        EXPECT_EQ(found.instance_ids[i] == 0, found.tile_ids[i] != kNoHit) << i;
    }
    EXPECT_LE(others, kAtRims);
    EXPECT_GT(std::count(found.instance_ids.begin(), found.instance_ids.end(), 1u), 100);
}

/// Invalid sets: modified copies of the set of the ball.
class WrongSets : public RaysThroughSets {
protected:
    WrongSets() {
        copy = folder.file("copy.proset");
        std::filesystem::copy(ball->tiles(), copy, std::filesystem::copy_options::recursive);
        for (std::uint32_t tile = 0; tile < ball->set.tiles.size(); ++tile)
            if (ball->set.tiles[tile].isOriginal()) path = tilePath(copy, ball->set.tiles[tile]);
    }
    std::string refusal(TraceError::Kind kind, std::uint64_t memory) const {
        try {
            castBoth(TraceScene(device, {copy}, {memory}), rays(20000));
        } catch (const TraceError& error) {
            EXPECT_EQ(error.kind, kind);
            return error.what();
        }
        return "nothing was thrown";
    }

    TemporaryFolder folder;
    std::string copy, path; ///< of the last tile
};

TEST_F(WrongSets, MissingOrTruncatedTile_IsNamed) {
    using Kind = TraceError::Kind;
    const std::uintmax_t bytes = std::filesystem::file_size(path);
    std::filesystem::resize_file(path, bytes - 4096);
    for (const std::uint64_t memory : {roomFor(1), SceneOptions{}.memory})
        EXPECT_SAYS(refusal(Kind::kBadInput, memory),
                    path + ": *set.json *" + std::to_string(bytes - 4096) + " bytes*" + std::to_string(bytes) + ")");
    std::filesystem::remove(path);
    EXPECT_EQ(refusal(Kind::kBadInput, roomFor(1)), path + ": No such file or directory");
    std::filesystem::remove(copy + "/set.json");
    EXPECT_EQ(refusal(Kind::kBadInput, roomFor(1)), copy + "/set.json: No such file or directory");
}

TEST_F(WrongSets, ChangedTile_IsRefusedWhenRead) {
    std::ptrdiff_t splats = 0;
    {
        const ProFile tile(path);
        splats = reinterpret_cast<const std::byte*>(tile.view().splats) - tile.bytes().data();
    }
    {
        std::fstream file(path, std::ios::in | std::ios::out | std::ios::binary);
        file.seekp(splats);
        file.write("\x5A\xA5\x5A\xA5\x5A\xA5\x5A\xA5", 8);
    }
    for (const std::uint64_t memory : {roomFor(1), SceneOptions{}.memory})
        EXPECT_TRUE(refusal(TraceError::Kind::kBadInput, memory).starts_with(path + ": ")) << memory;
}

TEST_F(WrongSets, TileAboveTheMemoryLimit_IsBadUsage) {
    const std::uint64_t needed = ball->largestTile();
    EXPECT_SAYS(refusal(TraceError::Kind::kBadUsage, needed / 2), "one tile *limit");
    EXPECT_SAYS(refusal(TraceError::Kind::kBadUsage, needed - 1), // the same number in MiB
                "one tile *" + std::to_string(needed) + " bytes *limit *" + std::to_string(needed - 1) + " bytes");
}

} // namespace
} // namespace pointrt::test

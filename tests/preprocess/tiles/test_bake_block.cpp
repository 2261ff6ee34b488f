// SPDX-License-Identifier: Apache-2.0
// Splats of tiles compared with those of the whole cloud.
#include "preprocess/tiles/bake_block.h"

#include <algorithm>
#include <filesystem>
#include <limits>
#include <map>
#include <set>

#include "format/set/verify_tile.h"
#include "pointrt/pro.h"
#include "preprocess/surface/estimate.h"
#include "preprocess/surface/neighbors.h"
#include "preprocess/surface/outliers.h"
#include "preprocess/tiles/halo.h"
#include "preprocess/tiles/make_tiles.h"
#include "preprocess/tiles/splat_file.h"
#include "set_fixture.h"

namespace pointrt {
namespace {

struct PlainSplats {
    std::vector<Vec3f> positions, normals; ///< relative to the plan's corner
    std::vector<float> radii;
};

/// All tiles' own splats.
PlainSplats splatsOf(const SetPlan& plan) {
    PlainSplats all;
    for (const PlanTile& tile : plan.tiles) {
        const TileSplats splats = readSplats(splatsFolder(plan), keyOf(tile));
        for (std::size_t i = 0; i < splats.positions.size(); ++i) {
            const Vec3d position = positionOf(latticeOf(plan), keyOf(tile), splats.positions[i]);
            all.positions.push_back((position - plan.lattice_origin).cast<float>());
            all.normals.push_back(normalOf(splats.normals[i]));
            all.radii.push_back(splats.radii[i]);
        }
    }
    return all;
}

SetPlan bakeAll(SetPlan plan) {
    bakeBlocks(plan, {0, plan.blocks()}, 2);
    return plan;
}

/// Counts splats of tiles whose normal or radius differs from that of the whole cloud as one file.
/// @param apart largest distance of a splat from that of the whole; the point spacing is 0.6 or 1
std::size_t countOtherThanWhole(const SetRequest& request, const SetPlan& plan, float apart = 1e-3f) {
    const PlainSplats tiles = splatsOf(plan);
    SurfaceReport report;
    const Splats whole = estimateSplats(readInputs(request.inputs, {}), request.bake.surface, report);
    EXPECT_EQ(tiles.positions.size(), whole.positions.size());
    const surface::NearestSearch search(tiles.positions);
    std::size_t differ = 0;
    for (std::size_t i = 0; i < whole.positions.size(); ++i) {
        const Vec3d position = whole.origin + whole.positions[i].cast<double>() - plan.lattice_origin;
        std::uint32_t at = 0;
        float squared = 0;
        EXPECT_EQ(search.nearest(position.cast<float>(), {&at, 1}, {&squared, 1}), 1u);
        EXPECT_LT(squared, apart * apart);
        const bool same = tiles.normals[at].dot(whole.normals[i]) > 0.9998f && // 1 degree
                          std::abs(tiles.radii[at] / whole.radii[i] - 1) < 0.01f;
        differ += !same;
    }
    return differ;
}

/// No visible seams: tiles estimate the same splats as the whole cloud.
TEST_F(SetTest, TilesHaveTheSplatsOfTheWhole) {
    const SetRequest request = requestOf({writeHill("a.csv", 30000)}, 3000);
    const SetPlan plan = bakeAll(splitInto("A.proset", request));
    ASSERT_GE(plan.tiles.size(), 8u);
    EXPECT_LE(countOtherThanWhole(request, plan), 3u); // one in 10,000
}
/// One corner a hundred times as dense as elsewhere, and few points per tile: halos must be wider than tiles.
TEST_F(SetTest, TilesOfFewPointsGetWiderHalos) {
    std::string text = "x,y,z\n";
    for (std::uint64_t i = 0; i < 24120; ++i) {
        const double size = i < 4120 ? 100 : 22;
        const double x = size * unitShare(mixBits(2 * i + 1)), y = size * unitShare(mixBits(2 * i + 2));
        text += fmt::format("{:.4f},{:.4f},{:.4f}\n", x, y, 3 * std::sin(x / 9) * std::cos(y / 7));
    }
    SetRequest request = requestOf({folder.write("uneven.csv", text)}, 4000);
    request.bake.surface.clean = 0;
    const SetPlan plan = readPlan(splitInto("A.proset", request).work); // with the statistics of the whole cloud
    EXPECT_EQ(bakeBlocks(plan, {0, plan.blocks()}, 2).lacking, 0u);
    EXPECT_EQ(countOtherThanWhole(request, plan), 0u);
    // the 95% quantile lies in the sparse part, which a few places would hardly sample
    const surface::PointSet points = surface::takePoints(readInputs(request.inputs, {}));
    const surface::NearestSearch search(points.positions);
    const auto k = static_cast<std::size_t>(request.bake.surface.neighbors);
    const surface::NeighborLists lists = findNeighbors(points, search, k, {StageProgress{}, ""});
    std::vector<float> reaches;
    for (std::size_t i = 0; i < points.size(); ++i) reaches.push_back(lists.radius(points, i));
    const double whole = std::ldexp(surface::commonReach(reaches), points.scale_exponent);
    EXPECT_NEAR(readPlan(plan.work).statistics.common_reach.value_or(0), whole, 0.002 * whole);
}

/// A plane of 40,000 points with a tree crown, 0.7% of all points, and scan lines, 1.2%. In their tiles both exceed the
/// thresholds of 1% and 2% above which a cloud is treated differently, in the whole cloud they do not.
std::string planeWithCrownAndLines() {
    std::string text = "x,y,z\n";
    const auto add = [&](double x, double y, double z) { text += fmt::format("{:.4f},{:.4f},{:.4f}\n", x, y, z); };
    const auto share = [](std::uint64_t i) { return unitShare(mixBits(i)); };
    for (std::uint64_t i = 0; i < 40000; ++i) add(100 * share(2 * i), 100 * share(2 * i + 1), 0);
    for (std::uint64_t i = 100000; i < 100300; ++i)
        add(10 + 5 * share(3 * i), 10 + 5 * share(3 * i + 1), 5 + 5 * share(3 * i + 2));
    for (int line = 0; line < 5; ++line)
        for (int i = 0; i < 100; ++i) add(80 + 0.08 * i, 80 + 0.6 * line, 12);
    return text;
}

TEST_F(SetTest, WhatAWholeCloudDecidesItsTilesDoNot) {
    SetRequest request = requestOf({folder.write("place.csv", planeWithCrownAndLines())}, 4000);
    request.bake.surface.clean = 0;
    request.bake.surface.orient = OrientMode::kUp;
    SetPlan plan = readPlan(splitInto("A.proset", request).work);
    EXPECT_EQ(plan.statistics.scattered, std::optional<bool>(false));
    EXPECT_EQ(plan.statistics.fill_rows, std::optional<std::uint32_t>(0));
    ASSERT_TRUE(plan.statistics.common_reach);
    EXPECT_NEAR(*plan.statistics.common_reach, 1.3, 0.3) << "16 of 4 points a square: 1.13 in the mean";
    plan.bake = request.bake;
    EXPECT_EQ(countOtherThanWhole(request, bakeAll(plan)), 0u);
}

/// Points in a cube, on no surface: all become balls, which have the radii of the whole cloud's.
TEST_F(SetTest, TilesHaveTheBallsOfTheWhole) {
    std::string text = "x,y,z\n";
    for (std::uint64_t i = 0; i < 24000; ++i)
        text += fmt::format("{:.4f},{:.4f},{:.4f}\n", 50 * unitShare(mixBits(3 * i + 1)),
                            50 * unitShare(mixBits(3 * i + 2)), 50 * unitShare(mixBits(3 * i + 3)));
    SetRequest request = requestOf({folder.write("cube.csv", text)}, 6000);
    request.bake.surface.splat = SplatShape::kAuto;
    SetPlan plan = readPlan(splitInto("A.proset", request).work);
    EXPECT_TRUE(plan.statistics.volume);
    plan.bake = request.bake;
    const TileCounts counts = bakeBlocks(plan, {0, plan.blocks()}, 2);
    EXPECT_EQ(counts.balls, counts.splats);
    const PlainSplats tiles = splatsOf(plan);
    ASSERT_EQ(tiles.positions.size(), counts.splats);
    SurfaceReport report;
    const Splats whole = estimateSplats(readInputs(request.inputs, {}), request.bake.surface, report);
    const surface::NearestSearch search(tiles.positions);
    std::size_t found = 0;
    for (std::size_t i = 0; i < whole.positions.size(); ++i) {
        const Vec3d position = whole.origin + whole.positions[i].cast<double>() - plan.lattice_origin;
        std::uint32_t at = 0;
        float squared = 0;
        ASSERT_EQ(search.nearest(position.cast<float>(), {&at, 1}, {&squared, 1}), 1u);
        EXPECT_EQ(tiles.normals[at], Vec3f(Vec3f::Zero()));
        found += squared < 1e-6f && std::abs(tiles.radii[at] / whole.radii[i] - 1) < 0.01f;
    }
    EXPECT_GT(found, whole.positions.size() * 99 / 100); // outliers may differ
}

TEST_F(SetTest, BlocksInAnyOrderAndTwiceGiveTheSameBytes) {
    const SetRequest request = requestOf({writeHill("a.csv", 8000)});
    SetPlan one = splitInto("A.proset", request), other = splitInto("B.proset", request, 1);
    const auto tiles = static_cast<std::uint32_t>(one.tiles.size());
    ASSERT_GE(tiles, 4u);
    one.first_tile_of_block = {0, tiles};
    other.first_tile_of_block = {0, 1, tiles / 2, tiles};
    bakeBlocks(one, {0, 1}, 1);
    for (const std::uint32_t block : {2u, 0u, 1u, 2u}) bakeBlocks(other, {block, block + 1}, 4);
    EXPECT_EQ(bakeBlocks(other, {1, 2}, 4).points, 0u) << "finished work is not repeated";
    for (const PlanTile& tile : one.tiles) {
        const std::string bytes = bytesOf(splatFileOf(splatsFolder(one), keyOf(tile)));
        EXPECT_FALSE(bytes.empty());
        EXPECT_EQ(bytes, bytesOf(splatFileOf(splatsFolder(other), keyOf(tile))));
    }
}

TEST_F(SetTest, ADamagedSplatFileIsRewritten) {
    SetPlan plan = bakeAll(splitInto("A.proset", requestOf({writeHill("a.csv", 5000)})));
    const std::string path = splatFileOf(splatsFolder(plan), keyOf(plan.tiles.front()));
    const std::string whole = bytesOf(path);
    std::filesystem::resize_file(path, whole.size() / 2);
    bakeAll(plan);
    EXPECT_EQ(bytesOf(path), whole);
}

/// Dense areas have tiles of finer levels beside those of coarser ones.
TEST_F(SetTest, TheWholeSetIsValidAndHoldsEverySplatOnce) {
    const std::vector<std::string> inputs{writeHill("a.csv", 3000), writeHill("b.csv", 6000, 30, 20)};
    SetPlan plan = bakeAll(splitInto("A.proset", requestOf(inputs)));
    std::uint64_t splats = 0;
    std::set<std::uint32_t> levels;
    for (const PlanTile& tile : plan.tiles) {
        splats += readSplatSummary(splatsFolder(plan), keyOf(tile)).head.count;
        levels.insert(tile.level);
    }
    EXPECT_GE(levels.size(), 2u);
    mergeLevels(plan, 1000, 2);
    for (std::uint32_t block = 0; block < plan.blocks(); ++block) makeBlockTiles(plan, {block, block + 1}, "{}", 1);
    makeSet(plan, R"({"writer":"test"})", 1);
    const TileSet set = readTileSet(plan.output);
    EXPECT_EQ(set.splats, splats);
    EXPECT_EQ(set.tiles.front().level + 1, set.levels.size());
    for (const SetTile& tile : set.tiles) {
        std::size_t findings = 1;
        const std::string path = plan.output + "/" + tile.file;
        EXPECT_EQ(pro_verify(path.c_str(), nullptr, nullptr, &findings, nullptr), PRO_OK);
        EXPECT_EQ(findings, 0u) << tile.file;
    }
    for (std::size_t i = 0; i < set.tiles.size(); ++i)
        for (const TileFinding& finding : verifyTile(set, plan.output, i)) ADD_FAILURE() << finding.text;
}

/// Files of a folder and its subfolders, by relative path.
std::map<std::string, std::string> filesBelow(const std::string& at) {
    std::map<std::string, std::string> files;
    for (const auto& entry : std::filesystem::recursive_directory_iterator(at))
        if (entry.is_regular_file()) files[entry.path().lexically_relative(at)] = bytesOf(entry.path());
    return files;
}

std::uint64_t bytesBelow(const std::string& at) {
    std::uint64_t bytes = 0;
    for (const auto& [name, content] : filesBelow(at)) bytes += content.size();
    return bytes;
}

TEST_F(SetTest, DroppingSplatFilesDoesNotChangeTiles) {
    const SetRequest request = requestOf({writeHill("a.csv", 8000), writeHill("b.csv", 8000, 30, 20)});
    SetPlan keeping = bakeAll(splitInto("A.proset", request)), dropping = bakeAll(splitInto("B.proset", request));
    dropping.bake.drop_work = true;
    mergeLevels(keeping, 1000, 2);
    mergeLevels(dropping, 1000, 2);
    const std::string splats = splatsFolder(dropping);
    const std::uint64_t before = bytesBelow(splats);
    makeSet(keeping, "{}", 2);
    EXPECT_EQ(bytesBelow(splatsFolder(keeping)), before);

    ASSERT_GE(dropping.blocks(), 2u);
    makeBlockTiles(dropping, {0, 1}, "{}", 2); // as if killed here
    const std::uint64_t between = bytesBelow(splats);
    EXPECT_LT(between, before);
    makeSet(dropping, "{}", 2);
    EXPECT_LT(bytesBelow(splats), between / 4) << "only summaries are left";
    EXPECT_EQ(filesBelow(dropping.output), filesBelow(keeping.output));
    makeSet(dropping, "{}", 2);
    EXPECT_EQ(filesBelow(dropping.output), filesBelow(keeping.output)) << "existing tiles need no splats";
}

/// A flat field with noise of half a spacing: cleaning moves some points across borders of tiles.
TEST_F(SetTest, SplatsMovedToANeighborAreKept) {
    std::string text = "x,y,z\n";
    for (std::uint64_t i = 0; i < 14000; ++i) { // from 8000 on in a corner, where tiles are finer
        const double size = i < 8000 ? 64 : 26;
        const double x = size * unitShare(mixBits(3 * i)), y = size * unitShare(mixBits(3 * i + 1));
        double noise = -1.5;
        for (std::uint64_t k = 0; k < 3; ++k) noise += unitShare(mixBits((3 * i + 2) << 2 | k));
        text += fmt::format("{:.4f},{:.4f},{:.4f}\n", x, y, 0.3 * x + 0.4 * y + 0.7 * noise);
    }
    SetPlan plan = bakeAll(splitInto("A.proset", requestOf({folder.write("field.csv", text)}, 2500)));
    std::uint64_t splats = 0, moved_out = 0;
    for (const PlanTile& tile : plan.tiles) {
        const TileSplats own = readSplats(splatsFolder(plan), keyOf(tile));
        splats += own.positions.size();
        moved_out += std::uint64_t(std::count_if(own.positions.begin(), own.positions.end(),
                                                 [](const PositionCode& code) { return !isInCore(code); }));
    }
    EXPECT_GT(moved_out, 10u);
    mergeLevels(plan, 2500, 2);
    makeSet(plan, "{}", 2);
    const TileSet set = readTileSet(plan.output);
    EXPECT_EQ(set.splats, splats);
    for (std::size_t i = 0; i < set.tiles.size(); ++i)
        for (const TileFinding& finding : verifyTile(set, plan.output, i)) ADD_FAILURE() << finding.text;
}

/// A noisy plane of 120 x 120 samples one unit apart, seen from afar, with a hole of 4 x 4 samples.
std::string rangeGridWithAHole() {
    constexpr int kEdge = 120, kHole = 58, kHoleEnd = 62;
    std::string vertices, cells;
    int count = 0;
    for (int y = 0; y < kEdge; ++y)
        for (int x = 0; x < kEdge; ++x) {
            if (x >= kHole && x < kHoleEnd && y >= kHole && y < kHoleEnd) {
                cells += "0\n";
                continue;
            }
            const double noise = unitShare(mixBits(std::uint64_t(y * kEdge + x))) - 0.5;
            vertices += fmt::format("{} {} {:.4f}\n", x, y, noise);
            cells += fmt::format("1 {}\n", count++);
        }
    return fmt::format("ply\nformat ascii 1.0\nobj_info num_cols {0}\nobj_info num_rows {0}\nelement vertex {1}\n"
                       "property float x\nproperty float y\nproperty float z\nelement range_grid {2}\n"
                       "property list uchar int vertex_indices\nend_header\n{3}{4}",
                       kEdge, count, kEdge * kEdge, vertices, cells);
}

TEST_F(SetTest, TilesKnowTheSilhouettesOfRangeGrids) {
    const SetRequest request = requestOf({folder.write("grid.ply", rangeGridWithAHole())}, 4000);
    SetPlan plan = readPlan(splitInto("A.proset", request).work);
    ASSERT_GE(plan.tiles.size(), 4u);
    std::size_t flagged = 0;
    for (std::uint32_t tile = 0; tile < plan.tiles.size(); ++tile) {
        const BoxPoints points = readPoints(plan, tile, 3);
        ASSERT_EQ(points.silhouettes.size(), points.core.size());
        for (std::size_t i = 0; i < points.core.size(); ++i) flagged += points.core[i] && points.silhouettes[i];
    }
    EXPECT_EQ(flagged, 16u) << "four samples on each side of the hole";
    plan.bake = request.bake;
    SurfaceReport report;
    estimateSplats(readInputs(request.inputs, {}), request.bake.surface, report);
    EXPECT_GE(report.clean_dropped, 16u);
    EXPECT_NEAR(plan.statistics.noise.at(0), report.noise.at(0), 0.02 * double(report.noise.at(0)));
    constexpr float kSmoothedApart = 0.02f; // as the noise is sampled
    EXPECT_LE(countOtherThanWhole(request, bakeAll(plan), kSmoothedApart), 140u) << "one in a hundred";
}

TEST_F(SetTest, CleaningThatIsOffNeedsNoSilhouettes) {
    SetRequest request = requestOf({folder.write("grid.ply", rangeGridWithAHole())}, 4000);
    request.bake.surface.clean = 0;
    const SetPlan plan = splitInto("A.proset", request);
    EXPECT_FALSE(plan.schema.silhouettes);
    EXPECT_TRUE(readPoints(plan, 0, 3).silhouettes.empty());
}

/// A grid of points half a unit apart in a box with a halo of 3.
struct HaloScene {
    std::vector<Vec3f> positions;
    std::vector<std::uint8_t> core;

    void add(float x, float y, float z) {
        positions.emplace_back(x, y, z);
        const auto in = [](float each) { return each >= 0 && each < 10; };
        core.push_back(in(x) && in(y) && in(z));
    }
    void addPlane(float step) {
        for (float y = -3; y <= 13; y += step)
            for (float x = -3; x <= 13; x += step) add(x, y, 5);
    }
    std::size_t lacking() const {
        return countLacking(positions, core, {3, Vec3d::Constant(-3), Vec3d::Constant(13)}, 16);
    }
};

TEST(Halo, WideEnoughWhereNeighborsAreNearerThanTheRim) {
    HaloScene scene;
    scene.addPlane(0.5f); // the 16th neighbour is 1.1 away
    EXPECT_EQ(scene.lacking(), 0u);
}

TEST(Halo, TooNarrowWhereTheyAreNot) {
    HaloScene scene;
    scene.addPlane(1);               // 2.2 away, the rim 3 and more: their own neighbours lie beyond it
    EXPECT_GE(scene.lacking(), 36u); // of the 10 by 10 points, all but those 5 or more from every rim
}

TEST(Halo, NoPointsBeyondTheRimNothingLacks) {
    HaloScene scene;
    scene.addPlane(1);
    constexpr double kNever = std::numeric_limits<double>::infinity();
    const Halo whole{3, Vec3d::Constant(-kNever), Vec3d::Constant(kNever)};
    EXPECT_EQ(countLacking(scene.positions, scene.core, whole, 16), 0u);
    const Halo open_to_x{3, Vec3d(-3, -kNever, -kNever), Vec3d::Constant(kNever)};
    const std::size_t lacking = countLacking(scene.positions, scene.core, open_to_x, 16);
    EXPECT_EQ(lacking, 20u); // of x = 0 and 1 the rim is 3 and 4 away, their neighbours 2.2; of x = 2 it is 5
}

TEST(Halo, AStrayNeedsNoHalo) {
    HaloScene scene;
    scene.addPlane(0.5f);
    scene.add(1, 1, 9.5f);
    EXPECT_EQ(scene.lacking(), 0u);
}

TEST(Halo, PointsInTheMiddleNeedNoHalo) {
    HaloScene scene;
    for (int i = 0; i < 20; ++i) scene.add(5 + 0.15f * float(i % 5), 5 + 0.15f * float(i / 5), 5); // 4 from the rim
    EXPECT_EQ(scene.lacking(), 0u);
}

} // namespace
} // namespace pointrt

// SPDX-License-Identifier: Apache-2.0
// Decisions of the first pass.
#include "preprocess/tiles/make_plan.h"

#include <algorithm>
#include <numeric>

#include "preprocess/tiles/input_state.h"
#include "set_fixture.h"
#include "tests/support/says.h"

namespace pointrt {
namespace {

TEST_F(SetTest, ThePlanHasEveryPointOnce) {
    const SetRequest request = requestOf({writeHill("a.csv", 6000), writeHill("b.csv", 2000, 100)});
    const SetPlan plan = makePlan(request);
    EXPECT_EQ(plan.points, 8000u);
    EXPECT_EQ(plan.points_read, 8000u);
    EXPECT_GT(plan.tiles.size(), 8u);
    for (const PlanTile& tile : plan.tiles) EXPECT_LE(tile.points, 1500u);
    EXPECT_EQ(std::accumulate(plan.tiles.begin(), plan.tiles.end(), std::uint64_t{0},
                              [](std::uint64_t sum, const PlanTile& tile) { return sum + tile.points; }),
              8000u);
    EXPECT_EQ(plan.first_tile_of_block.back(), plan.tiles.size());
    EXPECT_EQ(plan.schema.scan_bytes, 1u);
    ASSERT_EQ(plan.schema.attributes.size(), 2u);
    EXPECT_EQ(plan.schema.attributes[0].name, "intensity");
    EXPECT_EQ(plan.schema.attributes[0].type, Scalar::kU16); // the text has integers below 60,000
    EXPECT_EQ(plan.schema.attributes[1].name, kScanNumber);
    EXPECT_TRUE(plan.schema.scan_attribute);
    EXPECT_EQ(plan.up_from, "data");
    EXPECT_EQ(plan.world.up, Vec3d::UnitZ());
    // text has no normals: the sample is oriented, and its ground faces up
    ASSERT_GT(plan.sides.normals.size(), 4000u);
    const auto& normals = plan.sides.normals;
    const auto up = std::count_if(normals.begin(), normals.end(), [](const Vec3f& normal) { return normal.z() > 0; });
    EXPECT_GT(double(up), 0.99 * double(normals.size())); // except on the step between the two
}

TEST_F(SetTest, APlanIsReadAsItWasWritten) {
    SetPlan plan = splitInto("A.proset", requestOf({writeHill("a.csv", 3000)}));
    const SetPlan read = readPlan(plan.work);
    EXPECT_EQ(read.tiles.size(), plan.tiles.size());
    EXPECT_EQ(read.lattice_origin, plan.lattice_origin);
    EXPECT_EQ(read.bounds.min(), plan.bounds.min());
    EXPECT_EQ(read.sides.positions, plan.sides.positions);
    EXPECT_EQ(read.settings, plan.settings);
    const std::string before = bytesOf(planFile(plan.work));
    writePlan(read);
    EXPECT_EQ(bytesOf(planFile(plan.work)), before);
    std::string axis = before;
    axis.replace(axis.find("\"points\":3000,\"largest_color\""), 0,
                 R"("no_data":[{"axis":3,"is_low":true,"limit":-5000.0}],)");
    std::ofstream(planFile(plan.work)) << axis;
    EXPECT_HAS(reasonOf([&] { readPlan(plan.work); }, ExitCode::kBadInput), "no_data");
    for (const char* damage : {"", "{", "[]", "{\"version\":1}", "{\"version\":2}"}) {
        std::ofstream(planFile(plan.work)) << damage;
        reasonOf([&] { readPlan(plan.work); }, ExitCode::kBadInput);
    }
}

TEST_F(SetTest, OtherOptionsAndInputsAreRefusedInOneLine) {
    const std::string input = writeHill("a.csv", 3000);
    SetRequest request = requestOf({input});
    const SetPlan plan = makePlan(request);
    requireSameRequest(plan, request);
    requireSameInputs(plan, request.inputs);
    requireUnwritten(plan, request.inputs);
    request.settings = R"({"tile-splats":2000})";
    EXPECT_HAS(reasonOf([&] { requireSameRequest(plan, request); }, ExitCode::kBadUsage), "*--tile-splats *1000*2000");
    reasonOf([&] { requireSameInputs(plan, {input, input}); }, ExitCode::kBadInput);
    reasonOf([&] { requireSameInputs(plan, {folder.file("b.csv")}); }, ExitCode::kBadInput);
    writeHill("a.csv", 3001);
    EXPECT_HAS(reasonOf([&] { requireUnwritten(plan, {input}); }, ExitCode::kBadInput), "a.csv *changed");
    reasonOf([&] { makePlan(requestOf({folder.file("missing.csv")})); }, ExitCode::kBadInput);
    reasonOf([&] { makePlan(requestOf({"-"})); }, ExitCode::kBadUsage);
}

TEST_F(SetTest, AFullDiskIsReported) {
    SetPlan plan = makePlan(requestOf({writeHill("a.csv", 3000)}));
    requireSpace(plan);
    const SpaceNeeded before = spaceNeeded(plan);
    plan.points *= 1'000'000'000'000; // 3000 million million: more than any disk has
    EXPECT_NEAR(double(spaceNeeded(plan).temporary) / double(before.temporary), 1e12, 1);
    EXPECT_HAS(reasonOf([&] { requireSpace(plan); }, ExitCode::kCannotWrite), "SITE.proset: *disk");
}

/// Measured with ten million points of `make_lidar`: at most 62 bytes of disk per point without an index and 109 with
/// one; 42 and 99 in the end.
TEST(SpaceNeeded, IsALittleMoreThanLidarTook) {
    SetPlan plan;
    plan.points = 10'000'000;
    plan.schema.colors = true;
    for (const Scalar type : {Scalar::kU16, Scalar::kU8, Scalar::kU8, Scalar::kU8, Scalar::kI8})
        plan.schema.attributes.push_back({"", type, 1, type});
    plan.schema.attributes.push_back({"rgb16", Scalar::kU16, 3, Scalar::kU16});
    plan.bake.surface.clean = 0;
    plan.bake.drop_work = true;
    const auto expectWithin = [&](std::uint64_t bytes, double took) {
        EXPECT_GE(double(bytes), 1e7 * took);
        EXPECT_LE(double(bytes), 1.2e7 * took);
    };
    expectWithin(spaceNeeded(plan).peak, 109);
    expectWithin(spaceNeeded(plan).final, 99);
    plan.bake.index = false;
    expectWithin(spaceNeeded(plan).peak, 62);
    expectWithin(spaceNeeded(plan).final, 42);
    plan.bake.drop_work = false; // nothing is dropped
    expectWithin(spaceNeeded(plan).peak, 62 + 0.4 * 35 + 42);
}

TEST_F(SetTest, TilesAreLimitedByMemoryWithANote) {
    SetRequest request = requestOf({writeHill("a.csv", 540'000)}, 1'000'000);
    request.bake.max_memory = std::uint64_t{512} << 20;
    const SetPlan plan = makePlan(request);
    EXPECT_GT(plan.tiles.size(), 1u);
    ASSERT_EQ(plan.notes.size(), 1u);
    EXPECT_EQ(plan.notes[0].file, "--tile-splats");
    EXPECT_SAYS(plan.notes[0].text, "1000000 *--max-memory*536870");
    request.inputs = {writeHill("few.csv", 1000)};
    EXPECT_TRUE(makePlan(request).notes.empty()) << "one tile has room for all";
}

TEST_F(SetTest, BoundsAndThinningWorkPerPoint) {
    SetRequest request = requestOf({writeHill("a.csv", 6000)});
    request.read.filter.bounds = Eigen::AlignedBox3d(Vec3d(0, 0, -10), Vec3d(50, 100, 10));
    request.read.filter.thin_spacing = 2;
    const SetPlan plan = splitInto("A.proset", request);
    const Cloud whole = readInputs(request.inputs, request.read);
    EXPECT_EQ(plan.points, whole.positions.size());
    EXPECT_LE(plan.bounds.max().x(), 50);
    EXPECT_EQ(plan.points + plan.points_filtered, 6000u);
}

} // namespace
} // namespace pointrt

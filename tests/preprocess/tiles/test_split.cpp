// SPDX-License-Identifier: Apache-2.0
// Points sorted into buckets.
#include "preprocess/tiles/split.h"

#include <algorithm>
#include <cstring>

#include "preprocess/tiles/measure_neighbor_distance.h"
#include "set_fixture.h"
#include "tests/support/says.h"

namespace pointrt {
namespace {

/// Positions and intensities, sorted.
using Rows = std::vector<std::array<double, 4>>;

void addRows(const Cloud& cloud, Rows& rows) {
    for (std::size_t i = 0; i < cloud.positions.size(); ++i) {
        const Vec3d position = cloud.origin + cloud.positions[i].cast<double>();
        std::uint16_t intensity = 0;
        std::memcpy(&intensity, cloud.attributes[0].values.data() + 2 * i, 2);
        // text has four digits, fewer than floats within a tile
        rows.push_back({std::round(position.x() * 1e4), std::round(position.y() * 1e4), std::round(position.z() * 1e4),
                        double(intensity)});
    }
}

Rows rowsOf(const SetPlan& plan) {
    Rows rows;
    for (std::uint32_t tile = 0; tile < plan.tiles.size(); ++tile) addRows(readBucket(plan, tile), rows);
    std::sort(rows.begin(), rows.end());
    return rows;
}

TEST_F(SetTest, MissingDataIsLeftOutAsOfFiles) {
    // wide enough that a tile's cube holds z = 9999: only the plan's limits keep these points out
    std::string good = "x,y,z,intensity\n", marked = good;
    for (int i = 0; i < 2000; ++i)
        good += i % 20 == 1 ? "0,0,0,7\n" : fmt::format("{},{},{},{}\n", 5000 + i % 40, 7000 + i / 40, i % 5, i);
    for (int i = 0; i < 3000; ++i)
        marked +=
            fmt::format("{},{},{},{}\n", 5000 + 1000 * (i % 50), 7000 + i / 50, i % 10 == 0 ? 9999 : i % 7, 1000 + i);
    const SetRequest request = requestOf({folder.write("a.csv", good), folder.write("b.csv", marked)});
    const SetPlan plan = splitInto("A.proset", request);
    const Cloud whole = readInputs(request.inputs, request.read);
    EXPECT_EQ(whole.points_no_data, 400u);
    EXPECT_EQ(plan.points, 4600u);
    EXPECT_EQ(plan.points_filtered, 400u);
    EXPECT_LE(plan.bounds.max().z(), 6);
    EXPECT_EQ(plan.bounds.min().x(), 5000);
    Rows expected;
    addRows(whole, expected);
    std::sort(expected.begin(), expected.end());
    EXPECT_EQ(rowsOf(plan), expected);
    ASSERT_EQ(plan.notes.size(), 2u); // the third note of single files is about their sizes
    ASSERT_EQ(whole.notes.size(), 3u);
    for (std::size_t i = 0; i < plan.notes.size(); ++i) EXPECT_EQ(plan.notes[i].text, whole.notes[i].text);
    // another process splits by what is in the plan's file
    const SetPlan read = readPlan(plan.work);
    removeTree(splitMark(plan));
    removeTree(bucketsFolder(plan));
    splitPoints(read, request);
    EXPECT_EQ(rowsOf(read), expected);
}

TEST_F(SetTest, EveryPointIsInTheBucketOfItsCore) {
    const SetRequest request = requestOf({writeHill("a.csv", 6000), writeHill("b.csv", 2000, -50)});
    const SetPlan plan = splitInto("A.proset", request);
    Rows rows, expected;
    for (std::uint32_t tile = 0; tile < plan.tiles.size(); ++tile) {
        const Cloud cloud = readBucket(plan, tile);
        ASSERT_EQ(cloud.positions.size(), plan.tiles[tile].points);
        const PlanBox core = coreOf(plan, plan.tiles[tile]);
        for (const Vec3f& position : cloud.positions) {
            ASSERT_GE(position.minCoeff(), 0);
            ASSERT_LT(double(position.maxCoeff()), core.sizes().x());
        }
        ASSERT_EQ(cloud.scans.size(), 2u);
        const std::size_t second = std::min(cloud.scans[1].first_point, cloud.positions.size());
        for (std::size_t i = 0; i < cloud.positions.size(); ++i)
            ASSERT_EQ(cloud.attributes[1].values[i], i >= second); // the number of the scan
        addRows(cloud, rows);
    }
    addRows(readInputs(request.inputs, {}), expected);
    std::sort(rows.begin(), rows.end());
    std::sort(expected.begin(), expected.end());
    EXPECT_EQ(rows, expected);
}

TEST_F(SetTest, HalosHoldThePointsOfTheBox) {
    const SetPlan plan = splitInto("A.proset", requestOf({writeHill("a.csv", 6000)}));
    std::vector<Vec3d> all;
    for (std::uint32_t tile = 0; tile < plan.tiles.size(); ++tile) {
        const Cloud cloud = readBucket(plan, tile);
        for (const Vec3f& position : cloud.positions) all.push_back(cloud.origin + position.cast<double>());
    }
    constexpr double kHalo = 4;
    for (std::uint32_t tile = 0; tile < plan.tiles.size(); ++tile) {
        const BoxPoints points = readPoints(plan, tile, kHalo);
        PlanBox box = coreOf(plan, plan.tiles[tile]);
        box = PlanBox(box.min() - Vec3d::Constant(kHalo), box.max() + Vec3d::Constant(kHalo));
        const auto within = [&](const Vec3d& position) { return box.contains(position); };
        EXPECT_EQ(points.cloud.positions.size(), std::size_t(std::count_if(all.begin(), all.end(), within)));
        EXPECT_EQ(std::uint64_t(std::count(points.core.begin(), points.core.end(), 1)), plan.tiles[tile].points);
        for (std::size_t i = 0; i < points.core.size(); ++i)
            EXPECT_TRUE(within(points.cloud.origin + points.cloud.positions[i].cast<double>()));
        EXPECT_EQ(points.side_normals.size(), points.side_positions.size());
        EXPECT_GT(points.side_normals.size(), 0u);
    }
}

TEST_F(SetTest, ThreadsDoNotMatter) {
    const SetRequest request = requestOf({writeHill("a.csv", 9000), writeHill("b.csv", 3000, 30)});
    const SetPlan one = splitInto("A.proset", request, 1), four = splitInto("B.proset", request, 4);
    EXPECT_EQ(bucketsOf(one), bucketsOf(four));
    EXPECT_EQ(bytesOf(one.work + "/sides.bin"), bytesOf(four.work + "/sides.bin"));
}

struct Killed {};

TEST_F(SetTest, AKilledSplitResumesToTheSameBytes) {
    std::vector<std::string> inputs;
    for (int i = 0; i < 5; ++i) inputs.push_back(writeHill(fmt::format("{}.csv", i), 2000, 20 * i));
    const SetRequest request = requestOf(inputs);
    const auto undisturbed = bucketsOf(splitInto("A.proset", request));
    SetRequest other = request;
    other.output = folder.file("B.proset");
    const SetPlan plan = makePlan(other);
    std::filesystem::create_directories(plan.work);
    SplitOptions options;
    options.points_between_marks = 2000;
    std::size_t first_file = 0;
    for (int kill = 1; kill <= 4; ++kill) { // once in each file except the first
        first_file = 100;
        EXPECT_THROW(splitPoints(
                         plan, other,
                         [&](const ReadStatus& status) {
                             first_file = std::min(first_file, status.file);
                             if (status.file >= std::size_t(kill)) throw Killed();
                         },
                         options),
                     Killed);
        EXPECT_EQ(first_file, std::size_t(kill - 1)) << "it resumes where it was";
        EXPECT_FALSE(isSplit(plan));
    }
    splitPoints(plan, other, {}, options);
    EXPECT_TRUE(isSplit(plan));
    EXPECT_EQ(bucketsOf(plan), undisturbed);
}

TEST_F(SetTest, AnInterruptedFinishIsResumed) {
    const SetRequest request = requestOf({writeHill("a.csv", 4000)});
    SetPlan plan = splitInto("A.proset", request);
    const auto whole = bucketsOf(plan);
    // as if killed while buckets were renamed: one is renamed, one has its trailer, the final mark is missing
    std::vector<std::uint64_t> bytes;
    for (const PlanTile& tile : plan.tiles) bytes.push_back(std::filesystem::file_size(bucketFile(plan, tile)) - 32);
    std::string list;
    for (const std::uint64_t each : bytes) list += (list.empty() ? "" : ",") + std::to_string(each);
    std::ofstream(plan.work + "/split.begun.json")
        << R"({"file":1,"scan":1,"kept":4000,"seen":0,"bytes":[)" << list << "]}";
    std::filesystem::remove(splitMark(plan));
    const std::string second = bucketFile(plan, plan.tiles[1]);
    std::filesystem::rename(second, second + ".part");
    splitPoints(plan, request, [](const ReadStatus&) { FAIL() << "nothing needs to be read"; });
    EXPECT_EQ(bucketsOf(plan), whole);
}

TEST_F(SetTest, DamagedBucketsAreReportedInOneLine) {
    const SetPlan plan = splitInto("A.proset", requestOf({writeHill("a.csv", 3000)}));
    const std::string path = bucketFile(plan, plan.tiles[0]), whole = bytesOf(path);
    const auto reason = [&] { return reasonOf([&] { readBucket(plan, 0); }, ExitCode::kBadInput); };
    std::string bytes = whole;
    bytes[100] = char(bytes[100] ^ 1);
    std::ofstream(path, std::ios::binary) << bytes;
    EXPECT_HAS(reason(), path + ": *checksum");
    std::ofstream(path, std::ios::binary) << whole.substr(0, whole.size() - 1);
    EXPECT_HAS(reason(), path + ": *plan");
    std::ofstream(path, std::ios::binary) << whole.substr(0, 5);
    EXPECT_NE(reason().find("truncated"), std::string::npos);
    std::filesystem::remove(path);
    EXPECT_NE(reason().find(path), std::string::npos);
}

/// Points of a plane one unit apart, with uniform noise of up to `off` on both sides.
std::string noisyPlane(double corner, double off) {
    std::string text;
    for (std::uint64_t i = 0; i < 10'000; ++i)
        text += fmt::format("{:.4f} {:.4f} {:.4f}\n", corner + double(i % 100) + 0.3 * unitShare(mixBits(3 * i)),
                            double(i / 100) + 0.3 * unitShare(mixBits(3 * i + 1)),
                            off * (2 * unitShare(mixBits(3 * i + 2)) - 1));
    return text;
}

TEST_F(SetTest, NoiseIsMeasuredOfEachScan) {
    const SetRequest request = requestOf(
        {folder.write("clean.xyz", noisyPlane(0, 0.001)), folder.write("noisy.xyz", noisyPlane(100, 0.5))}, 20'000);
    const SetPlan plan = readPlan(splitInto("A.proset", request).work);
    ASSERT_EQ(plan.statistics.noise.size(), 2u);
    EXPECT_LT(plan.statistics.noise[0], 0.01);
    EXPECT_NEAR(plan.statistics.noise[1], 0.5 / std::sqrt(3.0),
                0.1); // the standard deviation of a uniform distribution
    SetRequest unclean = request;
    unclean.bake.surface.clean = 0;
    EXPECT_TRUE(readPlan(splitInto("B.proset", unclean).work).statistics.noise.empty());
}

/// Sets with so many points that not every tile is sampled.
TEST_F(SetTest, NeighborDistanceSamplesAtLeastOneTile) {
    SetPlan plan = splitInto("A.proset", requestOf({writeHill("a.csv", 4000)}));
    const std::optional<float> all = measureNeighborDistance(plan);
    ASSERT_TRUE(all);
    plan.points = 3'200'000'000; // every hundredth tile
    ASSERT_LT(plan.tiles.size(), 50u);
    const std::optional<float> some = measureNeighborDistance(plan);
    ASSERT_TRUE(some);
    EXPECT_NEAR(*some, *all, 0.2f * *all);
}

TEST_F(SetTest, InputsThatChangeBetweenPassesAreReportedInOneLine) {
    const SetRequest request = requestOf({writeHill("a.csv", 3000)});
    SetPlan plan = makePlan(request);
    std::filesystem::create_directories(plan.work);
    writeHill("a.csv", 2999);
    const std::string reason = reasonOf([&] { splitPoints(plan, request); }, ExitCode::kBadInput);
    EXPECT_HAS(reason, "SITE.proset.work: *inputs *changed");
}

} // namespace
} // namespace pointrt

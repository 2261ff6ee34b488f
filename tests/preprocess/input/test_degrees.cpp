// SPDX-License-Identifier: Apache-2.0
// Scans in degrees of longitude and latitude.
#include "tests/preprocess/input/input_fixture.h"
#include "tests/support/las_file.h"

#include "preprocess/ingest/degrees.h"

namespace pointrt {
namespace {

/// Rounding error in metres of a float 1 to 2 degrees off the cloud's origin: half a step of 24 bits.
constexpr double kRounding = 0x1p-24 * 111320;

struct DegreesTest : InputTest {
    /// In thousandths of degrees and metres, relative to the offset.
    std::string file(const std::string& name, const std::vector<std::array<int, 3>>& points,
                     const std::string& system = "GEOGCS[\"WGS 84\"]", double north = 45, double east = 7) const {
        test::LasParts parts;
        parts.scale = 0.001;
        parts.offset[0] = east;
        parts.offset[1] = north;
        parts.records = {test::lasRecord("LASF_Projection", 2112, system)};
        for (const auto& [x, y, z] : points) parts.points.push_back(test::lasPoint(20, x, y, z, 0));
        return write(name, parts.bytes());
    }
    static ReadOptions scaling() {
        ReadOptions options;
        options.scales_degrees = true;
        return options;
    }
};

TEST_F(DegreesTest, LengthsMatchTablesOfTheEllipsoid) {
    // latitude, then metres per degree of longitude and latitude: tables of WGS 84
    const double known[][3] = {{0, 111319.49, 110574.28},
                               {45, 78846.84, 111131.78},
                               {-45, 78846.84, 111131.78},
                               {60, 55800.00, 111412.29},
                               {90, 0, 111693.98}};
    for (const auto& [latitude, east, north] : known) {
        EXPECT_NEAR(metresPerDegree(latitude).x(), east, 0.01) << latitude;
        EXPECT_NEAR(metresPerDegree(latitude).y(), north, 0.01) << latitude;
    }
}

TEST_F(DegreesTest, BecomeMetresAroundTheMiddle) {
    // 0.002 degrees wide and long around 7.001, 45.000; 12 m high
    const Cloud cloud = read(file("a.las", {{0, -1, 0}, {2, 1, 12000}, {1, 0, 7000}}), scaling());
    ASSERT_EQ(cloud.positions.size(), 3u);
    EXPECT_LT((world(cloud, 0) - Vec3d(-78.847, -111.132, 0)).norm(), kRounding);
    EXPECT_LT((world(cloud, 1) - Vec3d(78.847, 111.132, 12)).norm(), kRounding);
    EXPECT_LT((world(cloud, 2) - Vec3d(0, 0, 7)).norm(), kRounding);
    EXPECT_EQ(cloud.world.up, Vec3d(0, 0, 1));
    EXPECT_EQ(cloud.world.metres_per_unit, 1);
    EXPECT_EQ(cloud.world.crs, "");
    EXPECT_TRUE(cloud.world.from_above); // 222 m against 12
    EXPECT_EQ(cloud.source_header.find("LASF_Projection"), std::string::npos);
    ASSERT_EQ(cloud.notes.size(), 1u);
    EXPECT_HAS(cloud.notes[0].text, "metres *7.0010000, 45.0000000*78846.835 and 111131.777 m");
}

TEST_F(DegreesTest, SeveralFilesHaveOneMiddle) {
    const Cloud cloud = readInputs({file("a.las", {{0, 0, 0}}), file("b.las", {{4, 0, 0}})}, scaling());
    EXPECT_LT((world(cloud, 1) - world(cloud, 0) - Vec3d(4 * 78.84684, 0, 0)).norm(), kRounding);
}

TEST_F(DegreesTest, StayIfTheyMust) {
    const std::string path = file("a.las", {{0, 0, 0}, {2, 1, 12000}});
    const auto stays = [](const Cloud& cloud, const std::string& note) {
        EXPECT_LT((world(cloud, 1) - Vec3d(7.002, 45.001, 12)).norm(), 1e-5);
        ASSERT_EQ(cloud.notes.size(), 1u);
        EXPECT_HAS(cloud.notes[0].text, note);
    };
    stays(read(path), "degrees: *unit");
    ReadOptions placed = scaling();
    placed.transform = Eigen::Affine3d::Identity();
    stays(read(path, placed), "degrees: *unit");
    const std::string points = write("b.xyz", "1 2 3\n4 5 6\n");
    stays(readInputs({path, points}, scaling()), "only some *degrees");
    // coordinates that contradict the declared system
    const Cloud wrong = read(file("c.las", {{0, 0, 0}, {1, 0, 0}}, "GEOGCS[]", 5000000, 400000), scaling());
    EXPECT_EQ(world(wrong, 0), Vec3d(400000, 5000000, 0));
    ASSERT_EQ(wrong.notes.size(), 1u);
    EXPECT_HAS(wrong.notes[0].text, "not degrees");
    const Cloud metres = read(file("d.las", {{0, 0, 0}, {1, 0, 0}}, "PROJCS[UNIT[\"metre\",1]]"), scaling());
    EXPECT_LT((world(metres, 1) - Vec3d(7.001, 45, 0)).norm(), 1e-5);
    EXPECT_TRUE(metres.notes.empty());
}

} // namespace
} // namespace pointrt

// SPDX-License-Identifier: Apache-2.0
#include "tests/preprocess/input/input_fixture.h"

namespace pointrt {
namespace {

using PtxTest = InputTest;

/// A quarter rotation about +z, which takes +x to +y, and a translation; as rows, as in the file.
const std::string kTurned = "0 1 0 0\n-1 0 0 0\n0 0 1 0\n10 20 30 1\n";
const std::string kStill = "1 0 0 0\n0 1 0 0\n0 0 1 0\n0 0 0 1\n";

std::string header(int columns, int rows, const std::string& transform, const std::string& position = "10 20 30") {
    return fmt::format("{}\n{}\n{}\n1 0 0\n0 1 0\n0 0 1\n{}", columns, rows, position, transform);
}

TEST_F(PtxTest, RowsTimesMatrix) {
    const Cloud cloud = readText("a.ptx", header(1, 2, kTurned) + "1 2 3 0.5\n2 0 0 0.034912\n");
    ASSERT_EQ(cloud.positions.size(), 2u);
    EXPECT_LT((world(cloud, 0) - Vec3d(8, 21, 33)).norm(), 1e-6);
    EXPECT_LT((world(cloud, 1) - Vec3d(10, 22, 30)).norm(), 1e-6);
    EXPECT_EQ(attributeOf(cloud, "intensity").type, Scalar::kF32);
    EXPECT_EQ(numbersOf(cloud, "intensity"), (Numbers{0.5, 0.034912f}));
    EXPECT_TRUE(cloud.colors.empty());
    EXPECT_EQ(cloud.world.up, Vec3d(0, 0, 1));
    EXPECT_EQ(cloud.world.metres_per_unit, 1);
}

TEST_F(PtxTest, CellsAreInColumnOrderAndMayBeEmpty) {
    const Cloud cloud =
        readText("a.ptx", header(2, 3, kStill, "0 0 0") + "0 0 0 0.5\n1 0 0 1 10 20 30\n2 0 0 1 40 50 60\n"
                                                          "0 0 0 0.5 0 0 0\n3 0 0 1 70 80 90\n0 0 0 0.5\n");
    EXPECT_EQ(cloud.points_read, 3u);
    EXPECT_EQ(numbersOf(cloud, "row"), (Numbers{1, 2, 1}));
    EXPECT_EQ(numbersOf(cloud, "column"), (Numbers{0, 0, 1}));
    EXPECT_EQ(attributeOf(cloud, "row").type, Scalar::kU8);
    EXPECT_EQ(cloud.colors, (std::vector<Rgb8>{{10, 20, 30}, {40, 50, 60}, {70, 80, 90}}));
    EXPECT_HAS(notesOf(cloud), "a.ptx: 3 of 6 cells");
}

TEST_F(PtxTest, ScansHaveTheirOwnSensorsAndNumbers) {
    const Cloud cloud =
        readText("a.ptx", header(1, 2, kTurned) + "1 2 3 0.5\n2 0 0 0.25\n" + header(2, 1, kStill, "5 6 7") +
                              "5 6 8 0.5 1 0.5 0\n5 6 9 0.25 0.2 0.4 0.8\n");
    ASSERT_EQ(cloud.scans.size(), 2u);
    EXPECT_TRUE(cloud.scans[0].name.ends_with("a.ptx: scan 1")) << cloud.scans[0].name;
    EXPECT_EQ(numbersOf(cloud, "scan"), (Numbers{0, 0, 1, 1}));
    // The first scanner was at the origin of its frame; points and position of the second are registered.
    EXPECT_LT((*cloud.scans[0].sensor - Vec3d(10, 20, 30)).norm(), 1e-9);
    EXPECT_LT((*cloud.scans[1].sensor - Vec3d(5, 6, 7)).norm(), 1e-9);
    EXPECT_EQ(cloud.sensor_of_point, (std::vector<std::uint32_t>{0, 0, 1, 1}));
    EXPECT_EQ(cloud.colors[2], (Rgb8{255, 128, 0}));
    EXPECT_EQ(cloud.colors[3], (Rgb8{51, 102, 204}));
    EXPECT_EQ(readText("b.ptx", header(1, 1, kTurned) + "1 2 3\n").scans[0].name, (folder / "b.ptx").string());
}

TEST_F(PtxTest, ADefaultHeaderHasNoDistantScanner) {
    const Cloud cloud =
        readText("a.ptx", header(1, 2, kStill, "0 0 0") + "637012.2 849028.3 431.6\n636896.3 849087.7 446.3\n");
    EXPECT_FALSE(cloud.scans[0].sensor.has_value());
    EXPECT_TRUE(cloud.sensors.empty());
    // if it is close to its points the position is valid, and so is an explicit one
    EXPECT_TRUE(readText("b.ptx", header(1, 2, kStill, "0 0 0") + "1 0 0\n2 0 0\n").scans[0].sensor.has_value());
    EXPECT_TRUE(readText("c.ptx", header(1, 2, kTurned) + "90 0 0\n90 1 0\n").scans[0].sensor.has_value());
}

TEST_F(PtxTest, IsDetectedByContent) {
    const std::string scan = header(1, 1, kTurned) + "1 2 3 0.5\n";
    for (const char* name : {"a.pts", "a.txt", "noname"})
        EXPECT_LT((world(readText(name, scan), 0) - Vec3d(8, 21, 33)).norm(), 1e-6);
    EXPECT_EQ(readText("a.pts", "1\n1 2 3\n1\n4 5 6\n").positions.size(), 2u);
}

TEST_F(PtxTest, BadFilesSayWhy) {
    EXPECT_HAS(reasonOfText("a.ptx", header(1, 2, kTurned) + "1 2 3 0.5\n"), "a.ptx:1: *header *1 columns of 2 ");
    EXPECT_HAS(reasonOfText("a.ptx", header(1, 2, kTurned) + "1.5 2.5 3.5 0.5\n"), "truncated: *1 of 2 ");
    EXPECT_HAS(reasonOfText("a.ptx", header(1, 1, kTurned) + "1 2 x 0.5\n"), "a.ptx:11: 'x' *number");
    EXPECT_HAS(reasonOfText("a.ptx", header(1, 1, kTurned) + "1 2 3 4 5\n"), "3, 4, 6 or 7 *5");
    EXPECT_HAS(reasonOfText("a.ptx", header(2, 1, kTurned) + "1 2 3 4\n1 2 3\n"), "a.ptx:12: *3 numbers*4");
    EXPECT_HAS(reasonOfText("a.ptx", header(1, 1, kTurned) + "0 0 0 0.5\n"), "no points");
    EXPECT_HAS(reasonOfText("a.ptx", header(0, 0, kTurned)), "no points");
    EXPECT_HAS(reasonOfText("a.ptx", header(1, 1, "0 0 0 0\n0 0 0 0\n0 0 0 0\n0 0 0 1\n") + "1 2 3\n"),
               "a.ptx:7: *transform");
    EXPECT_HAS(reasonOfText("a.ptx", header(1, 1, "1 0 0 9\n0 1 0 9\n0 0 1 9\n0 0 0 1\n") + "1 2 3\n"), "transform");
    EXPECT_HAS(reasonOfText("a.ptx", "x\n"), "a.ptx:1: *columns*'x'");
    EXPECT_HAS(reasonOfText("a.ptx", "1\n1\n1 2\n"), "a.ptx:3: *3 numbers*position");
    EXPECT_HAS(reasonOfText("a.ptx", "1\n"), "truncated *header");
    for (const char* counts :
         {"1\n18446744073709551615", "18446744073709551615\n18446744073709551615", "4000000000\n1"})
        EXPECT_HAS(reasonOfText("a.ptx", counts + header(1, 1, kTurned).substr(3) + "1 2 3\n"), "header promises");
}

TEST_F(PtxTest, EveryPrefixIsReadOrRefused) {
    readPrefixes("a.ptx", header(1, 2, kTurned) + "1 2 3 0.5\n0 0 0 0.5\n" + header(1, 1, kStill) + "1 2 3 0.5 1 2 3");
}

} // namespace
} // namespace pointrt

// SPDX-License-Identifier: Apache-2.0
// Range grids in each format that has them.
#include <cmath>
#include <numbers>

#include "format/pointio/e57.h"
#include "tests/preprocess/input/input_fixture.h"
#include "tests/preprocess/input/points/e57_file.h"

namespace pointrt {
namespace {

using GridTest = InputTest;
using Cells = std::vector<std::uint32_t>;
constexpr std::uint32_t kNone = RangeGrid::kNoPoint, kOut = RangeGrid::kFilteredOut;

std::string ply(const std::string& vertices, int count, const std::string& cells, int rows, int columns) {
    return fmt::format(
        "ply\nformat ascii 1.0\nobj_info num_cols {}\nobj_info num_rows {}\nelement vertex {}\nproperty float x\n"
        "property float y\nproperty float z\nelement range_grid {}\nproperty list uchar int vertex_indices\n"
        "end_header\n{}{}",
        columns, rows, count, rows * columns, vertices, cells);
}

/// Vertices 0, 1 and 2, of which 1 is not finite, in 2 rows of 3.
const std::string kThree = ply("0 0 0\nnan 0 0\n2 0 1\n", 3, "1 0\n0\n1 1\n0\n1 2\n0\n", 2, 3);

void expectGrid(const Cloud& cloud, std::uint32_t rows, std::uint32_t columns, const Cells& cells) {
    ASSERT_EQ(cloud.grids.size(), 1u) << notesOf(cloud);
    EXPECT_EQ(cloud.grids[0].rows, rows);
    EXPECT_EQ(cloud.grids[0].columns, columns);
    EXPECT_EQ(cloud.grids[0].point_of_cell, cells);
}

TEST_F(GridTest, PlyRangeGridRowByRow) {
    const Cloud cloud = readText("a.ply", kThree);
    expectGrid(cloud, 2, 3, {0, kNone, kNone, kNone, 1, kNone});
    // the scanner looks along -z of its frame
    ASSERT_TRUE(cloud.scans[0].sensor.has_value());
    EXPECT_NEAR(cloud.scans[0].sensor->x(), 1, 1e-6);
    EXPECT_GT(cloud.scans[0].sensor->z(), 20);
}

TEST_F(GridTest, PlyThroughConf) {
    write("a.ply", kThree);
    const Cloud cloud = readText("s.conf", "bmesh a.ply 0 0 0 0 0 0 1\nbmesh a.ply 0 9 0 0 0 0 1\n");
    ASSERT_EQ(cloud.grids.size(), 2u);
    EXPECT_EQ(cloud.grids[0].point_of_cell, (Cells{0, kNone, kNone, kNone, 1, kNone}));
    EXPECT_EQ(cloud.grids[1].point_of_cell, (Cells{2, kNone, kNone, kNone, 3, kNone}));
    EXPECT_EQ(cloud.grids[1].scan, 1u);
    EXPECT_EQ(cloud.scans[1].first_point, 2u);
    EXPECT_EQ(cloud.sensors.size(), 2u);
}

TEST_F(GridTest, InvalidPlyGridsAreDroppedWithANote) {
    const auto without = [&](const std::string& bytes, const std::string& note) {
        const Cloud cloud = readText("a.ply", bytes);
        EXPECT_TRUE(cloud.grids.empty()) << note;
        EXPECT_EQ(cloud.positions.size(), 2u);
        EXPECT_HAS(notesOf(cloud), note);
    };
    const std::string two = "0 0 0\n1 0 0\n";
    without(ply(two, 2, "1 0\n1 2\n0\n0\n", 2, 2), "1 of its points *outside");
    without(ply(two, 2, "1 0\n1 -1\n0\n0\n", 2, 2), "1 of its points *outside");
    without(ply(two, 2, "1 0\n1 1e300\n0\n0\n", 2, 2), "1 of its points *outside");
    without(ply(two, 2, "2 0 1\n0\n0\n0\n", 2, 2), "1 of its points *occupied");
    without(ply(two, 2, "1 0\n1 0\n1 1\n0\n", 2, 2), "two cells");
}

TEST_F(GridTest, PlyGridsOfOtherSizesAreElementsLikeOthers) {
    std::string other = kThree;
    other.replace(other.find("num_rows 2"), 10, "num_rows 3");
    EXPECT_TRUE(readText("a.ply", other).grids.empty());
    std::string huge = kThree;
    huge.replace(huge.find("num_rows 2"), 10, "num_rows 9223372036854775810"); // times 3: 2^64 + 14
    EXPECT_TRUE(readText("b.ply", huge).grids.empty());
    EXPECT_TRUE(readText("c.ply", ply("0 0 0\n1 0 0\n", 2, "1 0\n1 1\n", 1, 2)).grids.empty());
    readPrefixes("p.ply", kThree);
}

TEST_F(GridTest, OrganisedPcd) {
    const std::string organised =
        "VERSION 0.7\nFIELDS x y z\nSIZE 4 4 4\nTYPE F F F\nCOUNT 1 1 1\nWIDTH 3\nHEIGHT 2\nDATA ascii\n"
        "0 0 1\nnan nan nan\n2 0 1\n0 1 1\n1 1 1\n2 1 1\n";
    expectGrid(readText("a.pcd", organised), 2, 3, {0, kNone, 1, 2, 3, 4});
    std::string list = organised;
    list.replace(list.find("WIDTH 3\nHEIGHT 2"), 16, "WIDTH 6\nHEIGHT 1");
    EXPECT_TRUE(readText("b.pcd", list).grids.empty());
}

TEST_F(GridTest, FilteredSamplesAreStillSamples) {
    const std::string path =
        write("a.pcd", "VERSION 0.7\nFIELDS x y z\nSIZE 4 4 4\nTYPE F F F\nCOUNT 1 1 1\nWIDTH 3\nHEIGHT 2\n"
                       "DATA ascii\n0 0 1\nnan nan nan\n2 0 1\n0 1 1\n1 1 1\n2 1 1\n");
    ReadOptions options;
    options.filter.bounds = Eigen::AlignedBox3d(Vec3d(-1, -1, -1), Vec3d(1.5, 9, 9));
    expectGrid(readInputs({path}, options), 2, 3, {0, kNone, kOut, 1, 2, kOut});
    options.filter = {};
    options.filter.every = 3; // keeps 2 of 5, too few for a grid
    EXPECT_TRUE(readInputs({path}, options).grids.empty());
}

const std::string kPtxHeader = "0 0 0\n1 0 0\n0 1 0\n0 0 1\n1 0 0 0\n0 1 0 0\n0 0 1 0\n0 0 0 1\n";

TEST_F(GridTest, PtxColumnByColumn) {
    const Cloud cloud = readText("a.ptx", "2\n3\n" + kPtxHeader + "0 0 0\n1 0 0\n1 0 1\n0 0 0\n1 1 0\n1 1 1\n");
    expectGrid(cloud, 3, 2, {kNone, kNone, 0, 2, 1, 3});
    EXPECT_FALSE(cloud.grids[0].wraps);
}

/// Columns at equal angles around the origin.
std::string turned(int columns, double angle) {
    std::string bytes = fmt::format("{}\n3\n{}", columns, kPtxHeader);
    for (int column = 0; column < columns; ++column)
        for (int row = -1; row <= 1; ++row) {
            const double azimuth = angle * column / columns;
            bytes += fmt::format("{} {} {}\n", 5 * std::cos(azimuth), 5 * std::sin(azimuth), row);
        }
    return bytes;
}

TEST_F(GridTest, AFullTurnWraps) {
    EXPECT_TRUE(readText("a.ptx", turned(40, 2 * std::numbers::pi)).grids.at(0).wraps);
    EXPECT_FALSE(readText("b.ptx", turned(40, 1.9 * std::numbers::pi)).grids.at(0).wraps);
    EXPECT_FALSE(readText("c.ptx", turned(40, std::numbers::pi)).grids.at(0).wraps);
}

class E57GridTest : public InputTest {
protected:
    void SetUp() override {
        if (!hasE57()) GTEST_SKIP() << "this build has no Rust: E57 is not tested";
    }
    /// Points at 0, 1, 2 ... on x, with a row and a column each, whose limits are given.
    Cloud readIndices(const std::vector<std::int64_t>& rows, const std::vector<std::int64_t>& columns,
                      std::int64_t least, std::int64_t most) const {
        std::vector<double> x(rows.size()), one(rows.size(), 1);
        for (std::size_t i = 0; i < x.size(); ++i) x[i] = static_cast<double>(i);
        return readText(
            "a.e57",
            test::e57File({{{test::e57Doubles("cartesianX", x), test::e57Doubles("cartesianY", one),
                             test::e57Doubles("cartesianZ", one), test::e57Whole("rowIndex", least, most, rows),
                             test::e57Whole("columnIndex", least, most, columns)}}}));
    }
};

TEST_F(E57GridTest, RowsAndColumns) {
    expectGrid(readIndices({5, 5, 6, 6}, {6, 5, 5, 6}, 5, 6), 2, 2, {1, 0, 2, 3});
    // without limits in the file, those of the points count
    constexpr std::int64_t kWide = std::int64_t{1} << 31;
    expectGrid(readIndices({5, 5, 6, 6}, {6, 5, 5, 7}, 0, kWide), 2, 3, {1, 0, kNone, 2, kNone, 3});
    expectGrid(readIndices({-5, -5, -4, -4}, {6, 5, 5, 6}, std::numeric_limits<std::int64_t>::min(),
                           std::numeric_limits<std::int64_t>::max()),
               2, 2, {1, 0, 2, 3});
}

TEST_F(E57GridTest, DegenerateGridsAreDropped) {
    constexpr std::int64_t kWide = std::int64_t{1} << 31;
    EXPECT_TRUE(readIndices({0, 1, 1, kWide}, {0, 0, 1, kWide}, 0, kWide).grids.empty());
    EXPECT_TRUE(readIndices({0, 1, 1, std::numeric_limits<std::int64_t>::max()}, {0, 0, 1, 1},
                            std::numeric_limits<std::int64_t>::min(), std::numeric_limits<std::int64_t>::max())
                    .grids.empty());
    EXPECT_TRUE(readIndices({7, 7, 7, 7}, {0, 1, 2, 3}, 0, kWide).grids.empty());
    const Cloud clash = readIndices({0, 0, 1, 1}, {0, 0, 1, 1}, 0, 1);
    EXPECT_TRUE(clash.grids.empty());
    EXPECT_HAS(notesOf(clash), "2 of its points *occupied");
}

TEST_F(E57GridTest, FurtherEchoesStayOutOfTheGrid) {
    expectGrid(readIndices({0, 0, 0, 1, 1}, {0, 0, 1, 0, 1}, 0, 1), 2, 2, {0, 2, 3, 4});
}

TEST_F(GridTest, SamplingMeshesMovesGridsAlong) {
    const std::string mesh = write("m.off", "OFF\n3 1 0\n0 0 5\n1 0 5\n0 1 5\n3 0 1 2\n");
    ReadOptions options;
    options.sample_count = 7;
    const Cloud cloud = readInputs({mesh, write("a.ply", kThree)}, options);
    expectGrid(cloud, 2, 3, {0, kNone, kNone, kNone, 1, kNone});
    EXPECT_EQ(cloud.grids[0].scan, 1u);
    EXPECT_EQ(world(cloud, 1), Vec3d(2, 0, 1));
}

TEST_F(GridTest, UnusedVerticesAreDropped) {
    std::string mesh = ply("9 9 9\n0 0 0\n1 0 0\n0 1 0\n", 4, "1 0\n1 1\n1 2\n1 3\n", 2, 2);
    mesh.replace(mesh.find("end_header\n"), 11, "element face 1\nproperty list uchar int vertex_indices\nend_header\n");
    expectGrid(readText("a.ply", mesh + "3 1 2 3\n"), 2, 2, {kOut, 0, 1, 2});
}

} // namespace
} // namespace pointrt

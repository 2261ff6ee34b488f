// SPDX-License-Identifier: Apache-2.0
#include "preprocess/surface/silhouettes.h"

#include <algorithm>
#include <cstdlib>
#include <gtest/gtest.h>
#include <random>

#include "preprocess/input/read.h"
#include "tests/preprocess/surface/depth_frames.h"

namespace pointrt {
namespace {

using test::depthFrame;
using Flags = std::vector<std::uint8_t>;

/// A grid's flags as text: "." for 0, "#" for 1, a blank for cells without a point; rows end in "\n".
std::string picture(const Cloud& cloud, const Flags& flags) {
    std::string text;
    for (std::uint32_t row = 0; row < cloud.grids[0].rows; ++row) {
        for (std::uint32_t column = 0; column < cloud.grids[0].columns; ++column) {
            const std::uint32_t cell = cloud.grids[0].at(row, column);
            text += cell >= RangeGrid::kFilteredOut ? ' ' : flags.empty() || flags[cell] == 0 ? '.' : '#';
        }
        text += '\n';
    }
    return text;
}

/// A wall one unit away with a hole of one cell.
Cloud wallWithAHole() {
    return depthFrame(
        5, 7, 0.01, [](double u, double v) { return std::abs(u) < 0.001 && std::abs(v) < 0.001 ? std::nan("") : 1.0; });
}

TEST(Silhouettes, SurroundAHoleButNotTheFrame) {
    const Cloud cloud = wallWithAHole();
    EXPECT_EQ(picture(cloud, flagSilhouettes(cloud)), ".......\n...#...\n..# #..\n...#...\n.......\n");
}

TEST(Silhouettes, LeftOutSamplesAreNotHoles) {
    Cloud cloud = wallWithAHole();
    std::replace(cloud.grids[0].point_of_cell.begin(), cloud.grids[0].point_of_cell.end(), RangeGrid::kNoPoint,
                 RangeGrid::kFilteredOut);
    EXPECT_TRUE(flagSilhouettes(cloud).empty());
}

TEST(Silhouettes, AreOnBothSidesOfAStep) {
    const Cloud cloud = depthFrame(5, 8, 0.01, [](double u, double) { return u < 0 ? 1.0 : 1.2; });
    EXPECT_EQ(picture(cloud, flagSilhouettes(cloud)), "...##...\n...##...\n...##...\n...##...\n...##...\n");
    const Cloud low = depthFrame(5, 8, 0.01, [](double u, double) { return u < 0 ? 1.0 : 1.05; });
    EXPECT_TRUE(flagSilhouettes(low).empty()); // five pixels are the depth limit
}

TEST(Silhouettes, PanoramasWrapAround) {
    Cloud cloud = depthFrame(3, 5, 0.01, [](double u, double) { return u < -0.015 ? std::nan("") : 1.0; });
    EXPECT_EQ(picture(cloud, flagSilhouettes(cloud)), " #...\n #...\n #...\n");
    cloud.grids[0].wraps = true;
    EXPECT_EQ(picture(cloud, flagSilhouettes(cloud)), " #..#\n #..#\n #..#\n");
}

/// Parallel view along -z of a slope of 8 (82.9 degrees) between flat parts.
Cloud ramp(double sensor_height) {
    Cloud cloud = depthFrame(5, 24, 1, [](double, double) { return 1.0; });
    for (std::uint32_t i = 0; i < cloud.positions.size(); ++i) {
        const auto column = float(i % 24), row = float(i / 24);
        cloud.positions[i] = {column, row, 8 * std::clamp(column - 8.f, 0.f, 8.f)};
    }
    cloud.scans[0].sensor = Vec3d(12, 2, sensor_height);
    return cloud;
}

TEST(Silhouettes, AreOnASteepSlopeInParallelView) {
    const Cloud cloud = ramp(10000);
    EXPECT_EQ(picture(cloud, flagSilhouettes(cloud)).substr(0, 25), "........#########.......\n");
}

TEST(Silhouettes, AreNotOnADistantFloor) {
    // a camera 1.5 above a floor, looking along it: at depth z, a pixel is z / 1.5 times as deep as wide
    const auto floor = [](double, double v) { return v < 0.05 ? std::nan("") : 1.5 / v; };
    const Cloud cloud = depthFrame(120, 9, 0.01, floor);
    const std::string flags = picture(cloud, flagSilhouettes(cloud));
    // the far end is not flagged either: the camera saw it
    EXPECT_EQ(std::count(flags.begin(), flags.end(), '#'), 0) << flags;
}

TEST(Silhouettes, OfStationsAreMixedPixelsAlone) {
    // a wall at 1, one at 3 behind it, and a sample between them at the edge
    const Cloud cloud = depthFrame(4, 12, 0.01, [](double u, double) { return u < -0.01 ? 1.0 : u > 0.0 ? 3.0 : 1.5; });
    EXPECT_EQ(picture(cloud, flagSilhouettes(cloud)).substr(0, 13), ".....#......\n");
}

TEST(Silhouettes, ThinThingsThatAStationSawStay) {
    // a wire one sample wide in front of a wall, and a wire in front of nothing
    const Cloud cloud = depthFrame(4, 12, 0.01, [](double u, double) {
        return u < -0.01 ? std::nan("") : std::abs(u) < 0.01 ? 1.0 : 3.0;
    });
    const Flags flags = flagSilhouettes(cloud);
    EXPECT_EQ(std::count(flags.begin(), flags.end(), 1), 0);
}

TEST(Silhouettes, NoiseIsNotASlope) {
    // pixels of 0.0005: for one sample in three, noise makes a neighbour 6 pixels nearer or further
    std::mt19937 random(1);
    std::normal_distribution<double> noise(0, 0.00125);
    const Cloud cloud = depthFrame(40, 40, 0.0005, [&](double, double) { return 1 + noise(random); });
    const Flags flags = flagSilhouettes(cloud);
    EXPECT_LE(std::count(flags.begin(), flags.end(), 1), 4);
}

TEST(Silhouettes, AreNotFlaggedInSparseGrids) {
    const Cloud cloud = depthFrame(8, 8, 0.01, [](double u, double v) {
        return int(std::floor(u * 100) + std::floor(v * 100)) % 2 == 0 ? 1.0 : std::nan("");
    });
    EXPECT_TRUE(flagSilhouettes(cloud).empty());
    EXPECT_TRUE(flagSilhouettes({}).empty());
}

TEST(Silhouettes, OfARealRangeScan) {
    const char* const data = std::getenv("POINTRT_DATA");
    if (!data) GTEST_SKIP() << "POINTRT_DATA is not set";
    const Cloud cloud = readInputs({std::string(data) + "/stanford_dragon_raw/dragonStandRight_0.ply"}, {});
    ASSERT_EQ(cloud.grids.size(), 1u);
    EXPECT_EQ(cloud.grids[0].rows, 262u);
    EXPECT_EQ(cloud.grids[0].columns, 483u);
    const Flags flags = flagSilhouettes(cloud);
    const auto share = double(std::count(flags.begin(), flags.end(), 1)) / double(flags.size());
    EXPECT_GT(share, 0.03);
    EXPECT_LT(share, 0.15);
}

} // namespace
} // namespace pointrt

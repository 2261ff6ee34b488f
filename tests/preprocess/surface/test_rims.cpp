// SPDX-License-Identifier: Apache-2.0
#include "preprocess/surface/rims.h"

#include <algorithm>
#include <cstdlib>
#include <gtest/gtest.h>
#include <random>

#include "preprocess/input/read.h"
#include "tests/preprocess/surface/grids.h"

namespace pointrt {
namespace {

using test::depthFrame;
using Flags = std::vector<std::uint8_t>;

/// The flags of a grid's cells, "." for 0, "#" for 1 and a blank for cells without a point; rows end in "\n".
std::string picture(const Cloud& cloud, const Flags& flags) {
    std::string text;
    for (std::uint32_t row = 0; row < cloud.grids[0].rows; ++row) {
        for (std::uint32_t column = 0; column < cloud.grids[0].columns; ++column) {
            const std::uint32_t cell = cloud.grids[0].at(row, column);
            text += cell >= RangeGrid::kLeftOut ? ' ' : flags.empty() || flags[cell] == 0 ? '.' : '#';
        }
        text += '\n';
    }
    return text;
}

/// A wall one unit away with a hole of a cell.
Cloud wallWithAHole() {
    return depthFrame(
        5, 7, 0.01, [](double u, double v) { return std::abs(u) < 0.001 && std::abs(v) < 0.001 ? std::nan("") : 1.0; });
}

TEST(Rims, AHoleHasARingAndTheFrameNone) {
    const Cloud cloud = wallWithAHole();
    EXPECT_EQ(picture(cloud, flagRims(cloud)), ".......\n...#...\n..# #..\n...#...\n.......\n");
}

TEST(Rims, WhatWasLeftOutIsNoHole) {
    Cloud cloud = wallWithAHole();
    std::replace(cloud.grids[0].point_of_cell.begin(), cloud.grids[0].point_of_cell.end(), RangeGrid::kNoPoint,
                 RangeGrid::kLeftOut);
    EXPECT_TRUE(flagRims(cloud).empty());
}

TEST(Rims, AStepHasARimOnBothSides) {
    const Cloud cloud = depthFrame(5, 8, 0.01, [](double u, double) { return u < 0 ? 1.0 : 1.2; });
    EXPECT_EQ(picture(cloud, flagRims(cloud)), "...##...\n...##...\n...##...\n...##...\n...##...\n");
    const Cloud low = depthFrame(5, 8, 0.01, [](double u, double) { return u < 0 ? 1.0 : 1.05; });
    EXPECT_TRUE(flagRims(low).empty()); // five times as deep as a pixel is wide
}

TEST(Rims, AFullTurnHasNoFrameAtItsSides) {
    Cloud cloud = depthFrame(3, 5, 0.01, [](double u, double) { return u < -0.015 ? std::nan("") : 1.0; });
    EXPECT_EQ(picture(cloud, flagRims(cloud)), " #...\n #...\n #...\n");
    cloud.grids[0].wraps = true;
    EXPECT_EQ(picture(cloud, flagRims(cloud)), " #..#\n #..#\n #..#\n");
}

/// Seen in parallel along -z: a slope of 8, that is 82.9 degrees, between flat parts.
Cloud ramp(double sensor_height) {
    Cloud cloud = depthFrame(5, 24, 1, [](double, double) { return 1.0; });
    for (std::uint32_t i = 0; i < cloud.positions.size(); ++i) {
        const auto column = float(i % 24), row = float(i / 24);
        cloud.positions[i] = {column, row, 8 * std::clamp(column - 8.f, 0.f, 8.f)};
    }
    cloud.scans[0].sensor = Vec3d(12, 2, sensor_height);
    return cloud;
}

TEST(Rims, ASlopeSeenInParallelIsARim) {
    const Cloud cloud = ramp(10000);
    EXPECT_EQ(picture(cloud, flagRims(cloud)).substr(0, 25), "........#########.......\n");
}

TEST(Rims, AFloorFarAwayIsNone) {
    // a camera 1.5 above a floor, looking along it: at depth z a step of a pixel goes z / 1.5 times as deep as across
    const auto floor = [](double, double v) { return v < 0.05 ? std::nan("") : 1.5 / v; };
    const Cloud cloud = depthFrame(120, 9, 0.01, floor);
    const std::string flags = picture(cloud, flagRims(cloud));
    EXPECT_EQ(std::count(flags.begin(), flags.end(), '#'), 9) << flags; // the far end, beyond which nothing is
}

TEST(Rims, ASampleOfTwoSurfacesIsARim) {
    // a wall at 1, one at 3 behind it, and on the edge a sample of both
    const Cloud cloud = depthFrame(4, 12, 0.01, [](double u, double) { return u < -0.01 ? 1.0 : u > 0.0 ? 3.0 : 1.5; });
    EXPECT_EQ(picture(cloud, flagRims(cloud)).substr(0, 13), "....###.....\n");
}

TEST(Rims, NoiseIsNoSlope) {
    // pixels of 0.0005: one neighbour of a sample in three is 6 of them nearer or further, by chance
    std::mt19937 random(1);
    std::normal_distribution<double> noise(0, 0.00125);
    const Cloud cloud = depthFrame(40, 40, 0.0005, [&](double, double) { return 1 + noise(random); });
    const Flags flags = flagRims(cloud);
    EXPECT_LE(std::count(flags.begin(), flags.end(), 1), 4);
}

TEST(Rims, CellsTooFarApartTellNothing) {
    const Cloud cloud = depthFrame(8, 8, 0.01, [](double u, double v) {
        return int(std::floor(u * 100) + std::floor(v * 100)) % 2 == 0 ? 1.0 : std::nan("");
    });
    EXPECT_TRUE(flagRims(cloud).empty());
    EXPECT_TRUE(flagRims({}).empty());
}

TEST(Rims, OfARealRangeScan) {
    const char* const data = std::getenv("POINTRT_DATA");
    if (!data) GTEST_SKIP() << "POINTRT_DATA is not set";
    const Cloud cloud = readInputs({std::string(data) + "/stanford_dragon_raw/dragonStandRight_0.ply"}, {});
    ASSERT_EQ(cloud.grids.size(), 1u);
    EXPECT_EQ(cloud.grids[0].rows, 262u);
    EXPECT_EQ(cloud.grids[0].columns, 483u);
    const Flags flags = flagRims(cloud);
    const auto rims = double(std::count(flags.begin(), flags.end(), 1)) / double(flags.size());
    EXPECT_GT(rims, 0.03);
    EXPECT_LT(rims, 0.15);
}

} // namespace
} // namespace pointrt

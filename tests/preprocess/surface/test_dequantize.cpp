// SPDX-License-Identifier: Apache-2.0
#include "preprocess/surface/dequantize.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <gtest/gtest.h>
#include <random>

#include "preprocess/input/read.h"
#include "tests/preprocess/surface/depth_frames.h"

namespace pointrt {
namespace {

using test::depthFrame;

constexpr double kPixel = 1 / 525.0; // Kinect: a focal length of 525 pixels
constexpr double kStep = 0.00285;    // in 1 / depth: 2.85 mm at 1 m
constexpr std::uint32_t kRows = 240, kColumns = 320;

double quantized(double depth, double step = kStep) { return 1 / (std::round(1 / depth / step) * step); }

/// A wall some 2 m away, half a metre nearer at the right of the frame.
double wall(double u, double v) { return 1 / (0.5 + 0.2 * u + 0.05 * v); }

/// The largest and mean error of the points against depth, in steps.
struct Errors {
    double most = 0, mean = 0;
};

template <typename Depth>
Errors errorsOf(const Cloud& cloud, const Depth& depth) {
    Errors errors;
    for (const Vec3f& p : cloud.positions) {
        const double truth = depth(p.x() / p.z(), p.y() / p.z());
        const double error = std::abs(1 / double(p.z()) - 1 / truth) / kStep;
        errors.most = std::max(errors.most, error);
        errors.mean += error / double(cloud.positions.size());
    }
    return errors;
}

/// The mean angle in degrees between a direction and the normals of triangles of cells 3 apart, in columns [from, to).
double meanAngle(const Cloud& cloud, const Vec3d& direction, std::uint32_t from, std::uint32_t to) {
    double sum = 0;
    std::size_t count = 0;
    const RangeGrid& grid = cloud.grids[0];
    for (std::uint32_t row = 0; row + 3 < grid.rows; ++row)
        for (std::uint32_t column = from; column + 3 < to; ++column) {
            const auto at = [&](std::uint32_t r, std::uint32_t c) -> Vec3d {
                return cloud.positions[grid.at(r, c)].cast<double>();
            };
            const Vec3d here = at(row, column);
            const Vec3d normal = (at(row, column + 3) - here).cross(at(row + 3, column) - here).normalized();
            sum += std::acos(std::min(1.0, std::abs(normal.dot(direction.normalized()))));
            ++count;
        }
    return sum / double(count) * 180 / 3.14159265358979;
}

// 1 / z = 0.5 + 0.2 x / z + 0.05 y / z is 1 = 0.5 z + 0.2 x + 0.05 y
const Vec3d kWallNormal(0.2, 0.05, 0.5);

TEST(Dequantize, FlattensAQuantizedWall) {
    Cloud cloud = depthFrame(kRows, kColumns, kPixel, [](double u, double v) { return quantized(wall(u, v)); });
    const double before = meanAngle(cloud, kWallNormal, 0, kColumns);
    const DequantizeReport report = dequantizeDepths(cloud);
    ASSERT_EQ(report.scans.size(), 1u);
    EXPECT_GT(report.moved, cloud.positions.size() * 9 / 10);
    const Errors errors = errorsOf(cloud, wall);
    EXPECT_LT(errors.mean, 0.03);
    EXPECT_LT(errors.most, 0.3);
    EXPECT_GT(before, 5);
    EXPECT_LT(meanAngle(cloud, kWallNormal, 0, kColumns), 1);
    // a step of depth over the square root of 12
    ASSERT_EQ(cloud.noise.size(), cloud.positions.size());
    const std::uint32_t middle = cloud.grids[0].at(kRows / 2, kColumns / 2);
    EXPECT_NEAR(cloud.noise[middle], 4 * kStep / std::sqrt(12), 0.1 * 4 * kStep / std::sqrt(12));
}

TEST(Dequantize, LeavesPointsAtTheCamera) {
    Cloud cloud = depthFrame(kRows, kColumns, kPixel, [](double u, double v) {
        return std::abs(u) < 0.02 && std::abs(v) < 0.02 ? 0.0 : quantized(wall(u, v)); // no depth
    });
    ASSERT_EQ(dequantizeDepths(cloud).scans.size(), 1u);
    const std::uint32_t none = cloud.grids[0].at(kRows / 2, kColumns / 2);
    EXPECT_EQ(cloud.positions[none], Vec3f(0, 0, 0));
    EXPECT_EQ(cloud.noise[none], 0);
    EXPECT_LT(meanAngle(cloud, kWallNormal, 0, kColumns / 3), 1);
}

TEST(Dequantize, MeasuresNoiseOtherThanQuantization) {
    std::mt19937 random(3);
    std::normal_distribution<double> noise(0, 0.6 * kStep);
    Cloud cloud = depthFrame(kRows, kColumns, kPixel,
                             [&](double u, double v) { return quantized(1 / (1 / wall(u, v) + noise(random))); });
    dequantizeDepths(cloud);
    EXPECT_LT(errorsOf(cloud, wall).mean, 0.06);
    EXPECT_LT(meanAngle(cloud, kWallNormal, 0, kColumns), 2);
    const std::uint32_t middle = cloud.grids[0].at(kRows / 2, kColumns / 2);
    EXPECT_NEAR(cloud.noise[middle] / (4 * kStep), std::sqrt(0.36 + 1 / 12.0), 0.06);
}

TEST(Dequantize, KeepsAnEdgeOfTenSteps) {
    const auto edge = [](double u, double v) { return 1 / (0.5 + 0.1 * v + (u < 0 ? 0.2 * u : 10 * kStep)); };
    Cloud cloud = depthFrame(kRows, kColumns, kPixel, [&](double u, double v) { return quantized(edge(u, v)); });
    ASSERT_EQ(dequantizeDepths(cloud).scans.size(), 1u);
    EXPECT_LT(errorsOf(cloud, edge).most, 0.75);
    EXPECT_LT(errorsOf(cloud, edge).mean, 0.05);
}

TEST(Dequantize, MovesNoPointFurtherThanItsUncertainty) {
    // single samples two steps in front of a wall, to which planes fit well without them
    const auto spikes = [](double u, double v) {
        const bool spike = std::lround(2 * u / kPixel) % 41 == 0 && std::lround(2 * v / kPixel) % 41 == 0;
        return quantized(1 / (1 / wall(u, v) + (spike ? 2 * kStep : 0)));
    };
    const Cloud before = depthFrame(kRows, kColumns, kPixel, spikes);
    Cloud cloud = before;
    ASSERT_EQ(dequantizeDepths(cloud).scans.size(), 1u);
    for (std::size_t i = 0; i < cloud.positions.size(); ++i) {
        const double depth = before.positions[i].z();
        const double moved = std::abs(1 / double(cloud.positions[i].z()) - 1 / depth);
        const double sigma = cloud.noise.empty() ? 0 : cloud.noise[i] / depth / before.positions[i].norm();
        ASSERT_LE(moved, 1.001 * std::max(kStep, 3 * sigma));
    }
}

TEST(Dequantize, HandlesWholeMillimetres) {
    const auto millimetres = [](double u, double v) { return std::round(0.3 * wall(u, v) * 1000) / 1000; };
    Cloud cloud = depthFrame(kRows, kColumns, kPixel, millimetres);
    ASSERT_EQ(dequantizeDepths(cloud).scans.size(), 1u);
    EXPECT_LT(meanAngle(cloud, kWallNormal, 0, kColumns), 1);
    const std::uint32_t middle = cloud.grids[0].at(kRows / 2, kColumns / 2);
    EXPECT_NEAR(cloud.noise[middle], 0.001 / std::sqrt(12), 0.0001);
}

TEST(Dequantize, HandlesFramesAlongAnyAxis) {
    Cloud cloud = depthFrame(kRows, kColumns, kPixel, [](double u, double v) { return quantized(wall(u, v)); });
    for (Vec3f& p : cloud.positions) p = {p.y(), -p.z(), p.x()};
    ASSERT_EQ(dequantizeDepths(cloud).scans.size(), 1u);
    for (Vec3f& p : cloud.positions) p = {p.z(), p.x(), -p.y()};
    EXPECT_LT(errorsOf(cloud, wall).mean, 0.03);
}

TEST(Dequantize, LeavesCleanGridsBitForBit) {
    std::mt19937 random(3);
    std::normal_distribution<double> noise(0, 0.6 * kStep);
    const auto tilted = [](double u, double) { return 1 / (0.5 + 0.2 * u); }; // constant depth in each column
    const auto noisy = [&](double u, double v) { return 1 / (1 / wall(u, v) + noise(random)); };
    const auto straight = [](double, double) { return 2.0; };
    const auto fine = [](double u, double v) { return quantized(wall(u, v), kStep / 200); };
    for (const std::function<double(double, double)>& depth :
         {std::function<double(double, double)>(wall), {tilted}, {noisy}, {straight}, {fine}}) {
        const Cloud before = depthFrame(kRows, kColumns, kPixel, depth);
        Cloud cloud = before;
        const DequantizeReport report = dequantizeDepths(cloud);
        EXPECT_EQ(report.moved, 0u);
        EXPECT_TRUE(cloud.noise.empty());
        EXPECT_EQ(cloud.positions, before.positions);
    }
}

TEST(Dequantize, IgnoresCoordinatesOfFewDigits) {
    const auto round = [](float value) { return std::round(value * 200) / 200; };
    Cloud cloud = depthFrame(kRows, kColumns, kPixel, wall);
    for (Vec3f& p : cloud.positions) p = {round(p.x()), round(p.y()), round(p.z())};
    EXPECT_TRUE(dequantizeDepths(cloud).scans.empty());
}

/// Mean angle in degrees of the normals in a part of a frame to their mean.
double spreadOf(const Cloud& cloud, std::uint32_t row, std::uint32_t column, std::uint32_t size) {
    std::vector<Vec3d> normals;
    Vec3d mean = Vec3d::Zero();
    const RangeGrid& grid = cloud.grids[0];
    for (std::uint32_t r = row; r + 5 < row + size; ++r)
        for (std::uint32_t c = column; c + 5 < column + size; ++c) {
            const std::uint32_t cells[] = {grid.at(r, c), grid.at(r, c + 5), grid.at(r + 5, c)};
            if (*std::max_element(cells, cells + 3) >= RangeGrid::kFilteredOut) continue;
            const auto at = [&](int i) -> Vec3d { return cloud.positions[cells[i]].cast<double>(); };
            normals.push_back((at(1) - at(0)).cross(at(2) - at(0)).normalized());
            mean += normals.back();
        }
    double sum = 0;
    for (const Vec3d& normal : normals) sum += std::acos(std::min(1.0, normal.dot(mean.normalized())));
    return sum / double(normals.size()) * 180 / 3.14159265358979;
}

TEST(Dequantize, RealFrames) {
    const char* const data = std::getenv("POINTRT_DATA");
    if (!data) GTEST_SKIP() << "POINTRT_DATA is not set";
    struct Place {
        const char* file;
        std::uint32_t row, column, size; ///< of a wall
        double least_before, most_after;
    };
    for (const Place& place : {Place{"capture0001.pcd", 300, 315, 110, 20, 3},
                               {"person.pcd", 60, 100, 100, 30, 4},
                               {"table_scene_mug_stereo_textured.pcd", 20, 340, 100, 14, 8}}) {
        Cloud cloud = readInputs({std::string(data) + "/pcl/" + place.file}, {});
        ASSERT_EQ(cloud.grids.size(), 1u);
        const double before = spreadOf(cloud, place.row, place.column, place.size);
        const DequantizeReport report = dequantizeDepths(cloud);
        ASSERT_EQ(report.scans.size(), 1u) << place.file;
        const double after = spreadOf(cloud, place.row, place.column, place.size);
        std::printf("%s: noise %.2f of the spacing, wall %.1f to %.1f degrees\n", place.file,
                    report.scans[0].noise_over_spacing, before, after);
        EXPECT_GT(before, place.least_before) << place.file;
        EXPECT_LT(after, place.most_after) << place.file;
    }
}

} // namespace
} // namespace pointrt

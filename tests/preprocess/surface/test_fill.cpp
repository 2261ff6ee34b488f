// SPDX-License-Identifier: Apache-2.0
// Points inserted between scan lines.
#include <gtest/gtest.h>

#include <algorithm>

#include "tests/preprocess/surface/shapes.h"

namespace pointrt::test {
namespace {

constexpr int kLines = 20, kAlong = 160; // on [0, 1]^2: eight times as dense along as across

/// Lines along x at these heights.
Shape sweptPlane(const std::vector<double>& heights) {
    Shape shape;
    for (std::size_t line = 0; line < heights.size(); ++line)
        for (int i = 0; i < kAlong; ++i)
            shape.add(Vec3d((i + 0.5) / kAlong, (double(line) + 0.5) / kLines, heights[line]), Vec3d::UnitZ());
    return shape;
}

Splats filledSplats(const Cloud& cloud, SurfaceReport& report) { return estimateSplats(Cloud(cloud), {}, report); }

bool isFilled(const Splats& splats, std::size_t i) { return splats.input_index[i] >= splats.input_count; }

TEST(Fill, ScanLinesOfAPlaneAreClosedByFineDiscs) {
    const Shape shape = sweptPlane(std::vector<double>(kLines, 0.0));
    Cloud cloud = shape.cloud();
    for (const Vec3f& p : cloud.positions) cloud.colors.push_back({std::uint8_t(255 * p.y()), 0, 100});
    SurfaceReport report;
    const Splats splats = filledSplats(cloud, report);
    EXPECT_EQ(splats.positions.size(), cloud.positions.size() + report.filled);
    EXPECT_EQ(splats.filled_from.size(), report.filled);
    EXPECT_GT(report.filled, cloud.positions.size() / 4) << "two rows in gaps of eight steps, two to three steps apart";
    EXPECT_LE(report.filled, cloud.positions.size());
    for (std::size_t i = 0; i < splats.positions.size(); ++i) {
        const Vec3f& p = splats.positions[i];
        EXPECT_LT(splats.radii[i], 5.5f / kAlong) << p.transpose(); // half the gap is 4
        if (!isFilled(splats, i)) continue;
        EXPECT_NEAR(p.z(), 0, 1e-4f);
        EXPECT_GT(std::abs(splats.normals[i].z()), 0.999f);
        EXPECT_NEAR(float(splats.colors[i][0]), 255 * p.y(), 2.5f) << "colours are blended";
        const Vec3f& from = cloud.positions[splats.filled_from[splats.input_index[i] - splats.input_count]];
        EXPECT_LT(std::abs(from.y() - p.y()), 0.5f / kLines) << "attributes come from the nearer line";
        EXPECT_NEAR(from.x(), p.x(), 0.5f / kAlong);
    }
    Random random(7);
    for (int i = 0; i < 2000; ++i) {
        const Vec3f place(0.05f + 0.9f * float(uniform(random)), 0.05f + 0.9f * float(uniform(random)), 0);
        bool closed = false;
        for (std::size_t k = 0; k < splats.positions.size() && !closed; ++k)
            closed = (splats.positions[k] - place).norm() < 0.95f * splats.radii[k];
        EXPECT_TRUE(closed) << place.transpose();
    }
}

/// A step of two fifths of the gap between lines, which only the normals distinguish from a slope.
TEST(Fill, DoesNotSpanAStep) {
    std::vector<double> heights(kLines, 0.0);
    std::fill(heights.begin() + kLines / 2, heights.end(), 0.02);
    const Shape shape = sweptPlane(heights);
    Cloud cloud = shape.cloud();
    cloud.normals = shape.normals;
    SurfaceReport report;
    const Splats splats = filledSplats(cloud, report);
    EXPECT_GT(report.filled, 18u * kAlong / 4);
    EXPECT_LE(report.filled, 18u * kAlong);
    for (const Vec3f& p : splats.positions)
        EXPECT_LT(std::min(std::abs(p.z()), std::abs(p.z() - 0.02f)), 1e-4f) << p.transpose();
}

TEST(Fill, FollowsTheCurvatureOfACylinder) {
    Shape shape;
    for (int line = 0; line < 24; ++line)
        for (int i = 0; i < 150; ++i) {
            const double angle = 2 * std::numbers::pi * line / 24;
            const Vec3d out(std::cos(angle), std::sin(angle), 0);
            shape.add(out + Vec3d(0, 0, 0.02 * i), out);
        }
    SurfaceReport report;
    Cloud cloud = shape.cloud();
    cloud.normals = shape.normals;
    const Splats splats = filledSplats(cloud, report);
    EXPECT_GT(report.filled, 24u * 150 / 4);
    EXPECT_LE(report.filled, 24u * 150);
    for (std::size_t i = 0; i < splats.positions.size(); ++i) {
        if (!isFilled(splats, i)) continue;
        const Vec3f out(splats.positions[i].x(), splats.positions[i].y(), 0);
        EXPECT_NEAR(out.norm(), 1, 5e-4f); // a chord would be 0.0086 off
        EXPECT_GT(splats.normals[i].dot(out.normalized()), 0.9995f);
    }
}

TEST(Fill, LeavesEvenSampling) {
    for (const Shape& shape : {gridPlane(50), randomPlane(4000), gridCube(30), randomSphere(4000)}) {
        SurfaceReport report;
        const Splats splats = filledSplats(shape.cloud(), report);
        EXPECT_EQ(report.filled, 0u);
        EXPECT_TRUE(splats.filled_from.empty());
    }
}

} // namespace
} // namespace pointrt::test

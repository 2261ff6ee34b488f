// SPDX-License-Identifier: Apache-2.0
// Planes, circles and spheres fitted to points of known shapes, in national coordinates.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <vector>

#include "pointrt/measure.hpp"
#include "runtime/measure/decimal_text.h"

namespace pointrt {
namespace {

constexpr Position kMiddle{2'635'812.75, 1'182'340.5, 431.25}; // LV95

/// Two orthonormal directions and the normal of a plane tilted by atan(3/4) about the x axis.
constexpr Position kAlong{1, 0, 0}, kUphill{0, 0.8, 0.6}, kNormal{0, -0.6, 0.8};

Position at(double along, double uphill, double off) {
    Position point = kMiddle;
    for (std::size_t axis = 0; axis < 3; ++axis)
        point[axis] += along * kAlong[axis] + uphill * kUphill[axis] + off * kNormal[axis];
    return point;
}

std::vector<Position> arc(std::size_t count, double radius, double degrees, double off = 0) {
    std::vector<Position> points;
    for (std::size_t i = 0; i < count; ++i) {
        const double angle = degrees * std::numbers::pi / 180 * static_cast<double>(i) / static_cast<double>(count);
        const double side = i % 2 == 0 ? off : -off;
        points.push_back(at((radius + side) * std::cos(angle), (radius + side) * std::sin(angle), 0));
    }
    return points;
}

void expectNear(const Position& a, const Position& b, double error) {
    for (std::size_t axis = 0; axis < 3; ++axis) EXPECT_NEAR(a[axis], b[axis], error) << axis;
}

TEST(Fits, APlaneHasItsNormalAndDeviation) {
    // 1 cm above and below a tilted plane, as on a chessboard, on a symmetric grid
    std::vector<Position> points;
    for (int i = -2; i < 2; ++i)
        for (int j = -3; j < 3; ++j) points.push_back(at(i + 0.5, j + 0.5, (i + j) % 2 == 0 ? 0.01 : -0.01));
    const FittedPlane plane = fitPlane(points);
    expectNear(plane.center, kMiddle, 1e-8);
    expectNear(plane.normal, kNormal, 2e-3);
    EXPECT_NEAR(plane.rms, 0.01, 1e-4);
    expectNear(fitPlane(std::vector{at(0, 0, 0), at(5, 0, 0), at(0, 3, 0)}).normal, kNormal, 1e-8);
}

TEST(Fits, ACircleThroughThreePicksIsExact) {
    const FittedCircle circle = fitCircle(arc(3, 1.25, 100));
    EXPECT_NEAR(circle.radius, 1.25, 1e-7);
    expectNear(circle.center, kMiddle, 1e-7);
    expectNear(circle.normal, kNormal, 1e-7);
    EXPECT_NEAR(circle.rms, 0, 1e-7);
}

TEST(Fits, NoisyArcsDoNotShrink) {
    // 1% noise on a fifth of a circle: the algebraic fit's radius is 15% too small
    const FittedCircle circle = fitCircle(arc(400, 2, 72, 0.02));
    EXPECT_NEAR(circle.radius, 2, 0.01);
    EXPECT_NEAR(circle.rms, 0.02, 5e-4);
}

TEST(Fits, ASphereOfItsCap) {
    std::vector<Position> cap;
    for (int ring = 1; ring <= 3; ++ring)
        for (int i = 0; i < 8; ++i) {
            const double polar = 0.2 * ring, around = std::numbers::pi / 4 * i;
            cap.push_back(at(7 * std::sin(polar) * std::cos(around), 7 * std::sin(polar) * std::sin(around),
                             7 * std::cos(polar)));
        }
    const FittedSphere sphere = fitSphere(cap);
    EXPECT_NEAR(sphere.radius, 7, 1e-6);
    expectNear(sphere.center, kMiddle, 1e-6);
    EXPECT_NEAR(sphere.rms, 0, 1e-7);
}

template <typename Fit>
std::string refusal(const Fit& fit) {
    try {
        fit();
    } catch (const TraceError& error) {
        EXPECT_EQ(error.kind, TraceError::Kind::kBadUsage);
        return error.what();
    }
    return "";
}

TEST(Fits, DegeneratePointsAreRefused) {
    const std::vector<Position> line{at(0, 0, 0), at(1, 0, 0), at(2, 0, 0), at(3, 0, 0)};
    const std::vector<Position> flat{at(0, 0, 0), at(1, 0, 0), at(0, 1, 0), at(1, 1, 0), at(2, 3, 0)};
    EXPECT_NE(refusal([&] { fitPlane(line); }).find("line"), std::string::npos);
    EXPECT_NE(refusal([&] { fitCircle(line); }).find("line"), std::string::npos);
    EXPECT_NE(refusal([&] { fitSphere(flat); }).find("plane"), std::string::npos);
    EXPECT_NE(refusal([&] { fitSphere(std::vector(4, kMiddle)); }).find("plane"), std::string::npos);
    EXPECT_NE(refusal([&] { fitCircle(std::span(line).first(2)); }).find("3"), std::string::npos);
    EXPECT_NE(refusal([&] {
                  fitPlane(std::vector<Position>{{0, 0, 0}, {0, NAN, 0}, {1, 0, 0}});
              }).find("point 2"),
              std::string::npos);
}

TEST(DecimalText, ResolvesTheStep) {
    EXPECT_EQ(decimalsOf(6e-5), 5);
    EXPECT_EQ(decimalsOf(1), 0);
    EXPECT_EQ(decimalsOf(0), 3);
    EXPECT_EQ(decimalText(-0.0001, 3), "0.000");
    EXPECT_EQ(decimalText(-12.5, 1), "-12.5");
}

} // namespace
} // namespace pointrt

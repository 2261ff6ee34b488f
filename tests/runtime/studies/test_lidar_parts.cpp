// SPDX-License-Identifier: Apache-2.0
// Parts of the simulated scanner, checked against formulas.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "runtime/studies/beam_footprint.h"
#include "runtime/studies/pattern.h"
#include "runtime/studies/philox.h"
#include "runtime/studies/returns.h"
#include "runtime/studies/scanner_path.h"

namespace pointrt::test {
namespace {

constexpr double kDegrees = 180 / std::numbers::pi;

double azimuthOf(Vec3 d) { return std::atan2(d.y, d.x) * kDegrees; }
double elevationOf(Vec3 d) { return std::asin(d.z) * kDegrees; }

/// The three vectors for philox4x32 with 10 rounds in Random123's kat_vectors file.
TEST(LidarPhilox, MatchesTheReferenceVectors) {
    using Words = std::array<std::uint32_t, 4>;
    EXPECT_EQ(philox({0, 0, 0, 0}, {0, 0}), (Words{0x6627E8D5, 0xE169C58D, 0xBC57AC4C, 0x9B00DBD8}));
    EXPECT_EQ(philox({~0u, ~0u, ~0u, ~0u}, {~0u, ~0u}), (Words{0x408F276D, 0x41C83B0E, 0xA20BC7C6, 0x6D5451FD}));
    EXPECT_EQ(philox({0x243F6A88, 0x85A308D3, 0x13198A2E, 0x03707344}, {0xA4093822, 0x299F31D0}),
              (Words{0xD16CFE09, 0x94FDCCEB, 0x5001E420, 0x24126EA1}));
}

TEST(LidarPhilox, IsUniformAndGaussian) {
    const LidarRandom random(7);
    constexpr int kCount = 100000;
    double mean = 0, square = 0, normal = 0, variance = 0;
    int beyond = 0;
    for (std::uint64_t i = 0; i < kCount; ++i) {
        const double u = random.uniform(i, LidarDraw::kDrop), g = random.gaussian(i, LidarDraw::kRange, 2);
        ASSERT_TRUE(u > 0 && u < 1 && std::isfinite(g));
        mean += u / kCount;
        square += u * u / kCount;
        normal += g / kCount;
        variance += g * g / kCount;
        beyond += std::abs(g) > 1.96 ? 1 : 0;
    }
    // each within four standard deviations of its estimate
    EXPECT_NEAR(mean, 0.5, 4 * std::sqrt(1 / 12.0 / kCount));
    EXPECT_NEAR(square, 1 / 3.0, 4 * std::sqrt(4 / 45.0 / kCount));
    EXPECT_NEAR(normal, 0, 4 / std::sqrt(1.0 * kCount));
    EXPECT_NEAR(variance, 1, 4 * std::sqrt(2.0 / kCount));
    EXPECT_NEAR(beyond, 0.05 * kCount, 4 * std::sqrt(0.05 * 0.95 * kCount));
}

TEST(LidarPhilox, DiffersBySeedPulsePurposeAndNumber) {
    const LidarRandom random(1);
    const double one = random.gaussian(5, LidarDraw::kRange, 0);
    EXPECT_EQ(one, LidarRandom(1).gaussian(5, LidarDraw::kRange, 0));
    EXPECT_NE(one, LidarRandom(1ull << 40).gaussian(5, LidarDraw::kRange, 0));
    EXPECT_NE(one, random.gaussian(5 + (1ull << 40), LidarDraw::kRange, 0));
    EXPECT_NE(one, random.gaussian(5, LidarDraw::kRange, 1));
    EXPECT_NE(one, random.gaussian(5, LidarDraw::kFootprint, 0));
}

TEST(LidarPattern, SpinningBeamsHaveTheirElevationsAndRotate) {
    const LidarPattern pattern = LidarSpinning{{-25, -1.5, 3}, 20, 0.5, 10, false};
    EXPECT_DOUBLE_EQ(firingTimes(pattern).cycle_s, 0.05);
    for (std::uint64_t k = 0; k < 3 * 2000; ++k) {
        const LidarPulse pulse = pulseOf(pattern, k);
        const double azimuth = 10 + 0.5 * static_cast<double>(k / 3);
        ASSERT_EQ(pulse.ring, k % 3);
        ASSERT_NEAR(elevationOf(pulse.direction), (std::array{-25.0, -1.5, 3.0})[k % 3], 1e-12);
        ASSERT_NEAR(std::remainder(azimuthOf(pulse.direction) - azimuth, 360), 0, 1e-9);
        ASSERT_NEAR(pulse.delay_s, static_cast<double>(k / 3) / 20 / 720, 1e-12);
        ASSERT_NEAR(length(pulse.direction), 1, 1e-15);
    }
    const LidarPulse other = pulseOf(LidarSpinning{{0}, 20, 0.5, 10, true}, 40);
    EXPECT_NEAR(azimuthOf(other.direction), -10, 1e-12);
}

/// Pixels of a pinhole camera are evenly spaced on a plane in front of it.
TEST(LidarPattern, FlashPixelsAreThoseOfAPinholeCamera) {
    const LidarPattern pattern = LidarFlash{4, 3, 90, 60, 30};
    for (std::uint64_t k = 0; k < 12; ++k) {
        const Vec3 d = pulseOf(pattern, k).direction;
        const double left = d.y / d.x, up = d.z / d.x;
        EXPECT_NEAR(left, 0.75 - 0.5 * static_cast<double>(k % 4), 1e-12) << k;
        EXPECT_NEAR(up, std::tan(30 / kDegrees) * (2 - 2 * static_cast<double>(k / 4)) / 3, 1e-12) << k;
        EXPECT_EQ(pulseOf(pattern, k).ring, k / 4);
        EXPECT_EQ(pulseOf(pattern, k).delay_s, 0);
    }
    EXPECT_NEAR(pulseOf(pattern, 12).delay_s, 1 / 30.0, 1e-15);
}

TEST(LidarPattern, AMirrorZigzagsFromLeftToRightAndBack) {
    const LidarPattern pattern = LidarOscillating{60, 50, 1000, false};
    for (std::uint64_t k = 0; k < 60; ++k) {
        const LidarPulse pulse = pulseOf(pattern, k);
        const double place = static_cast<double>(k % 20);
        const double expected = place < 10 ? -30 + 6 * place : 30 - 6 * (place - 10);
        EXPECT_NEAR(static_cast<double>(pulse.scan_angle_deg), expected, 1e-5) << k;
        EXPECT_NEAR(std::atan2(-pulse.direction.y, -pulse.direction.z) * kDegrees, expected, 1e-9) << k;
        EXPECT_NEAR(pulse.direction.x, 0, 1e-15);
        EXPECT_NEAR(pulse.delay_s, 1e-3 * static_cast<double>(k), 1e-15);
    }
    const LidarPattern sine = LidarOscillating{60, 50, 1000, true};
    for (std::uint64_t k = 0; k < 40; ++k)
        EXPECT_NEAR(static_cast<double>(pulseOf(sine, k).scan_angle_deg),
                    -30 * std::cos(2 * std::numbers::pi * static_cast<double>(k) / 20), 1e-5);
}

TEST(LidarPattern, ATableIsFiredRowByRow) {
    const LidarPattern pattern = LidarTable{{{0, 0, 5, 0}, {90, 45, 6, 0.01}}, 10};
    const LidarPulse third = pulseOf(pattern, 3);
    EXPECT_EQ(third.ring, 6);
    EXPECT_NEAR(third.delay_s, 0.11, 1e-15);
    EXPECT_NEAR(length(third.direction - Vec3{0, std::sqrt(0.5), std::sqrt(0.5)}), 0, 1e-15);
}

TEST(LidarTrajectory, YawPitchRollFollowTheirDefinition) {
    const auto turned = [](double yaw, double pitch, double roll, Vec3 v) {
        return ScannerPose{{}, lidarRotation(yaw, pitch, roll)}.rotated(v);
    };
    EXPECT_NEAR(length(turned(90, 0, 0, {1, 0, 0}) - Vec3{0, 1, 0}), 0, 1e-15);
    EXPECT_NEAR(length(turned(0, 90, 0, {1, 0, 0}) - Vec3{0, 0, -1}), 0, 1e-15); // lowers the front
    EXPECT_NEAR(length(turned(0, 0, 90, {0, 1, 0}) - Vec3{0, 0, 1}), 0, 1e-15);  // raises the left side
    EXPECT_NEAR(length(turned(90, 90, 0, {1, 0, 0}) - Vec3{0, 0, -1}), 0, 1e-15);
    EXPECT_NEAR(length(turned(90, 0, 90, {0, 1, 0}) - Vec3{0, 0, 1}), 0, 1e-15);
}

TEST(LidarTrajectory, PositionsAreLinearAndRotationsTakeTheShorterArc) {
    const std::array<double, 4> from = lidarRotation(170, 0, 0);
    std::array<double, 4> to = lidarRotation(-150, 0, 0); // 40 degrees further
    for (double& each : to) each *= -3;                   // the same rotation
    const ScannerPath path({{10, {0, 0, 0}, from}, {14, {8, 4, -4}, to}, {15, {8, 4, 0}, to}});
    const ScannerPose quarter = path.at(11), end = path.at(14);
    EXPECT_NEAR(length(quarter.position - Vec3{2, 1, -1}), 0, 1e-14);
    EXPECT_NEAR(azimuthOf(-1.0 * quarter.rotated({1, 0, 0})), 0, 1e-9); // 180, which is 170 + 40 / 4
    EXPECT_NEAR(azimuthOf(path.at(12).rotated({1, 0, 0})), -170, 1e-9);
    EXPECT_NEAR(azimuthOf(end.rotated({1, 0, 0})), -150, 1e-9);
    EXPECT_NEAR(length(path.at(14.5).position - Vec3{8, 4, -2}), 0, 1e-14);
    EXPECT_EQ(path.at(9).position, (Vec3{0, 0, 0}));
    EXPECT_EQ(path.at(99).position, (Vec3{8, 4, 0}));
}

/// Constant angular speed, where linear interpolation of quaternions would be faster in the middle.
TEST(LidarTrajectory, LargeRotationsHaveConstantSpeed) {
    const ScannerPath path({{0, {}, lidarRotation(0, 0, 0)}, {1, {}, lidarRotation(0, 0, 170)}});
    for (int i = 0; i <= 17; ++i) {
        const Vec3 left = path.at(i / 17.0).rotated({0, 1, 0});
        EXPECT_NEAR(std::atan2(left.z, left.y) * kDegrees, 10.0 * i, 1e-9);
    }
}

TEST(BeamFootprint, HoldsEqualSharesOfAGaussianBeam) {
    constexpr std::size_t kRays = 2000;
    const double half_angle = 0.5e-3; // of 1 mrad
    const BeamFootprint spot(1, kRays);
    const Vec3 axis = normalize({1, 2, -2});
    const BeamFootprint::Around around(axis, 0.3);
    for (const double circle : {0.2, 0.5, 0.8, 1.0}) {
        std::size_t within = 0;
        for (std::size_t i = 0; i < kRays; ++i)
            within += length(cross(axis, spot.ray(around, i))) <= circle * half_angle ? 1 : 0;
        // the integral of exp(-2 r^2) r dr up to this radius, divided by that up to r = 1
        const double expected = (1 - std::exp(-2 * circle * circle)) / (1 - std::exp(-2.0));
        EXPECT_NEAR(static_cast<double>(within) / kRays, expected, 1.0 / kRays) << circle;
    }
    Vec3 sum;
    for (std::size_t i = 0; i < kRays; ++i) {
        ASSERT_NEAR(length(spot.ray(around, i)), 1, 1e-14);
        sum = sum + spot.ray(around, i) * (1.0 / kRays);
    }
    EXPECT_LT(length(cross(axis, sum)), 0.01 * half_angle); // symmetric about the axis
    EXPECT_EQ(BeamFootprint(1, 1).ray(around, 0), axis);
}

TEST(LidarReturns, AreSplitAtGapsWiderThanTheResolution) {
    std::vector<RayEcho> touches{{10.5, 1, 1, 3, 0}, {20, 2, 1, 4, 0}, {10, 3, 1, 1, 0}, {10.9, 0, 1, 2, 0}};
    std::vector<LidarReturn> returns;
    findReturns(touches, 0.5, returns);
    ASSERT_EQ(returns.size(), 2u); // 10, 10.5 and 10.9 are a chain
    EXPECT_DOUBLE_EQ(returns[0].range, (3 * 10 + 10.5) / 4);
    EXPECT_DOUBLE_EQ(returns[0].power, 4);
    EXPECT_EQ(returns[0].strongest.splat, 1u);
    EXPECT_DOUBLE_EQ(returns[1].range, 20);
    findReturns(touches, 0.3, returns);
    EXPECT_EQ(returns.size(), 4u);
    findReturns({}, 1, returns);
    EXPECT_TRUE(returns.empty());
}

} // namespace
} // namespace pointrt::test

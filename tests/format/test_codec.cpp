// SPDX-License-Identifier: Apache-2.0
// The codec keeps to the worst-case errors in SPEC.md.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>

#include "pointrt/pro.h"

namespace {

// SPEC.md, "Precision"
constexpr double kPositionError = 0x1p-22; // cube units, per axis
constexpr double kNormalErrorDeg = 0.0397; // covering radius at (1,1,1): sqrt(2) * 2/4095 rad
constexpr double kNormalMeanDeg = 0.0197;
constexpr double kDegPerRad = 57.29577951308232;

pro_splat roundTrip(const pro_splat& splat, float radius_max, float radius_step) {
    std::uint32_t words[PRO_SPLAT_WORDS];
    pro_splat decoded;
    pro_splat_encode(&splat, radius_max, radius_step, words);
    EXPECT_EQ(words[1] >> 31, 0u);
    pro_splat_decode(words, radius_max, radius_step, &decoded);
    return decoded;
}

/// Angle from the chord, which is exact for small angles, too.
double angleDeg(const float a[3], const float b[3]) {
    const double chord = std::hypot(double{a[0]} - b[0], double{a[1]} - b[1], double{a[2]} - b[2]);
    return 2 * std::asin(chord / 2) * kDegPerRad;
}

pro_splat splatAt(float x, float y, float z) { return {{x, y, z}, {0, 0, 1}, 0.125f, {1, 2, 3}, 4}; }

TEST(Codec, PositionsStayWithinHalfAStep) {
    std::mt19937 random(1);
    std::uniform_real_distribution<float> unit(0, 1);
    for (int i = 0; i < 300000; ++i) {
        const pro_splat splat = splatAt(unit(random) * 0.999999f, unit(random) * 0.001f, unit(random) * 0.999999f);
        const pro_splat decoded = roundTrip(splat, 0.25f, 0.125f);
        for (int axis = 0; axis < 3; ++axis)
            ASSERT_LE(std::fabs(double{decoded.position[axis]} - splat.position[axis]), kPositionError);
    }
}

TEST(Codec, PositionsNeverLeaveTheirStep) {
    // floor(x * 2^21) must not change: a centre stays in its octree cell at every depth
    for (const std::uint32_t code : {0u, 1u, 2047u, 2048u, 0x155555u, 0x1FFFFEu, 0x1FFFFFu}) {
        const float low = static_cast<float>(code) * PRO_POSITION_STEP;
        for (const float at : {low, std::nextafter(low + PRO_POSITION_STEP, 0.0f)}) {
            const pro_splat decoded = roundTrip(splatAt(at, at, at), 1, 0.125f);
            for (int axis = 0; axis < 3; ++axis)
                EXPECT_EQ(decoded.position[axis], (static_cast<float>(code) + 0.5f) * PRO_POSITION_STEP);
        }
    }
}

TEST(Codec, PositionsOutsideTheCubeAreClamped) {
    const float nan = std::numeric_limits<float>::quiet_NaN();
    const pro_splat decoded = roundTrip(splatAt(-1, 1, nan), 1, 0.125f);
    EXPECT_EQ(decoded.position[0], 0.5f * PRO_POSITION_STEP);
    EXPECT_EQ(decoded.position[1], 1 - 0.5f * PRO_POSITION_STEP);
    EXPECT_EQ(decoded.position[2], 0.5f * PRO_POSITION_STEP);
    const pro_splat far = roundTrip(splatAt(1e30f, -1e30f, std::numeric_limits<float>::infinity()), 1, 0.125f);
    EXPECT_EQ(far.position[2], 1 - 0.5f * PRO_POSITION_STEP);
}

TEST(Codec, NormalsStayWithinTheStatedAngle) {
    std::mt19937 random(2);
    std::normal_distribution<float> gauss;
    double sum = 0, worst = 0;
    constexpr int kCount = 400000;
    for (int i = 0; i < kCount; ++i) {
        pro_splat splat = splatAt(0.5f, 0.5f, 0.5f);
        const bool corner = i % 2 == 0; // the octahedral map is worst at its face centres
        for (float& component : splat.normal) component = corner ? 1 + 0.01f * gauss(random) : gauss(random);
        if (corner && i % 4 == 0) splat.normal[2] = -splat.normal[2];
        const float length = std::hypot(splat.normal[0], splat.normal[1], splat.normal[2]);
        for (float& component : splat.normal) component /= length;
        const pro_splat decoded = roundTrip(splat, 0.25f, 0.125f);
        const double angle = angleDeg(decoded.normal, splat.normal);
        ASSERT_NEAR(std::hypot(decoded.normal[0], decoded.normal[1], decoded.normal[2]), 1, 4e-7);
        ASSERT_LE(angle, kNormalErrorDeg) << splat.normal[0] << ' ' << splat.normal[1] << ' ' << splat.normal[2];
        worst = std::max(worst, angle);
        sum += corner ? 0 : angle;
    }
    EXPECT_GE(worst, 0.95 * kNormalErrorDeg) << "SPEC.md could state less";
    EXPECT_LE(sum / (kCount / 2), kNormalMeanDeg);
}

TEST(Codec, NormalsAnyLengthAxesAndZero) {
    for (int axis = 0; axis < 3; ++axis)
        for (const float sign : {-1.0f, 1.0f}) {
            pro_splat splat = splatAt(0.5f, 0.5f, 0.5f);
            float unit[3] = {0, 0, 0};
            unit[axis] = sign;
            for (int i = 0; i < 3; ++i) splat.normal[i] = unit[i] * 1e-20f;
            EXPECT_LE(angleDeg(roundTrip(splat, 1, 0.125f).normal, unit), kNormalErrorDeg);
        }
    const float infinite = std::numeric_limits<float>::infinity();
    for (const float bad : {0.0f, infinite, std::numeric_limits<float>::quiet_NaN()}) {
        const pro_splat decoded = roundTrip({{0, 0, 0}, {bad, 0, 0}, 1, {}, 0}, 1, 0.125f);
        EXPECT_GT(decoded.normal[2], 0.999f);
    }
}

TEST(Codec, RadiiNeverShrinkAndGrowByLessThanAStep) {
    std::mt19937 random(3);
    std::uniform_real_distribution<float> octaves(0, 30), steps(0.01f, 0.125f);
    for (int i = 0; i < 300000; ++i) {
        const float step = steps(random), radius_max = 0.3f;
        const float deepest = 255 * step;
        pro_splat splat = splatAt(0.5f, 0.5f, 0.5f);
        splat.radius = radius_max * std::exp2(-std::min(octaves(random), deepest * 0.999f));
        const float decoded = roundTrip(splat, radius_max, step).radius;
        ASSERT_GE(decoded, splat.radius);
        ASSERT_LE(decoded, splat.radius * std::exp2(step) * 1.00001f);
    }
}

TEST(Codec, RadiiAtTheEndsOfTheScale) {
    const auto radiusOf = [](float radius, float step) {
        pro_splat splat = splatAt(0.5f, 0.5f, 0.5f);
        splat.radius = radius;
        return roundTrip(splat, 0.5f, step).radius;
    };
    EXPECT_EQ(radiusOf(0.5f, 0.125f), 0.5f);
    EXPECT_EQ(radiusOf(0.25f, 0.125f), 0.25f);
    EXPECT_EQ(radiusOf(7.0f, 0.125f), 0.5f) << "above the largest: clamped";
    EXPECT_EQ(radiusOf(0.01f, 0.0f), 0.5f) << "a single radius";
    EXPECT_EQ(radiusOf(0.0f, 0.125f), 0.5f * std::exp2(-255 * 0.125f)) << "the smallest code";
}

TEST(Codec, ColorsAndMaterialsAreExact) {
    for (unsigned value = 0; value < 256; ++value) {
        pro_splat splat = splatAt(0.1f, 0.9f, 0.5f);
        const auto byte = static_cast<std::uint8_t>(value);
        splat.color[0] = byte;
        splat.color[1] = static_cast<std::uint8_t>(255 - value);
        splat.color[2] = static_cast<std::uint8_t>(value ^ 0x55);
        splat.material = byte;
        const pro_splat decoded = roundTrip(splat, 0.25f, 0.125f);
        EXPECT_EQ(decoded.color[0], splat.color[0]);
        EXPECT_EQ(decoded.color[1], splat.color[1]);
        EXPECT_EQ(decoded.color[2], splat.color[2]);
        EXPECT_EQ(decoded.material, byte);
    }
}

TEST(Codec, WordsAreLaidOutAsSpecified) {
    // x = 1, y = 2^11 + 3, z = 5 in steps; +x; colour 0x332211, material 7; one octave below the largest radius
    const pro_splat splat = {{1.5f * PRO_POSITION_STEP, 2051.5f * PRO_POSITION_STEP, 5.5f * PRO_POSITION_STEP},
                             {1, 0, 0},
                             0.5f,
                             {0x11, 0x22, 0x33},
                             7};
    std::uint32_t words[PRO_SPLAT_WORDS];
    pro_splat_encode(&splat, 1, 0.25f, words);
    EXPECT_EQ(words[0], 1u | 3u << 21);
    EXPECT_EQ(words[1], 1u | 5u << 10);
    EXPECT_EQ(words[2] & 0xFFF, 4095u);
    EXPECT_EQ(words[2] >> 24, 7u);
    EXPECT_EQ(words[3], 0x332211u | 4u << 24);
}

} // namespace

// SPDX-License-Identifier: Apache-2.0
// Which Gaussians a file stores exactly, and that pictures of them equal those of their input.
#include "preprocess/octree/exact_gaussians.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace pointrt::test {
namespace {

constexpr double kUsual = 1;

/// A Gaussian with deviations 10, 1 and 0.1 and opacity 0.5.
pro_exact_gaussian longGaussian() { return {7, {1, 0, 0, 0}, {10, 1, 0.1f}, 0.5f}; }

pro_gaussian decodedAs(const pro_exact_gaussian& exact) {
    pro_gaussian decoded{};
    std::copy_n(exact.rotation, 4, decoded.rotation);
    std::copy_n(exact.deviation, 3, decoded.deviation);
    decoded.opacity = exact.opacity;
    return decoded;
}

/// A rotation about z, which moves the end of the first axis by 10 times the angle.
pro_gaussian turned(double radians) {
    pro_gaussian decoded = decodedAs(longGaussian());
    decoded.rotation[0] = static_cast<float>(std::cos(radians / 2));
    decoded.rotation[3] = static_cast<float>(std::sin(radians / 2));
    return decoded;
}

TEST(ExactGaussians, AreThoseWhoseAxesMove) {
    EXPECT_FALSE(codesShow(longGaussian(), decodedAs(longGaussian()), kUsual));
    EXPECT_FALSE(codesShow(longGaussian(), turned(0.00029), kUsual));
    EXPECT_TRUE(codesShow(longGaussian(), turned(0.00031), kUsual));
    EXPECT_FALSE(codesShow(longGaussian(), turned(0.00031), 2 * kUsual)) << "small among others";
    pro_gaussian longer = decodedAs(longGaussian());
    longer.deviation[0] = 10.0029f;
    EXPECT_FALSE(codesShow(longGaussian(), longer, kUsual));
    longer.deviation[0] = 9.9968f;
    EXPECT_TRUE(codesShow(longGaussian(), longer, kUsual));
    pro_gaussian negative = decodedAs(longGaussian());
    negative.rotation[0] = -1;
    EXPECT_FALSE(codesShow(longGaussian(), negative, kUsual)) << "the same rotation";
}

TEST(ExactGaussians, AreThoseWhoseOpacityShows) {
    const auto shows = [](float given, float decoded) {
        pro_exact_gaussian exact = longGaussian();
        exact.opacity = given;
        pro_gaussian rounded = decodedAs(exact);
        rounded.opacity = decoded;
        return codesShow(exact, rounded, kUsual);
    };
    EXPECT_FALSE(shows(0.5f, 0.52f));
    EXPECT_TRUE(shows(0.5f, 0.53f));
    EXPECT_FALSE(shows(0.01f, 0.0104f));
    EXPECT_TRUE(shows(0.01f, 0.0106f));
    EXPECT_TRUE(shows(0.00393f, 4 / 1023.0f)) << "would vanish";
    EXPECT_TRUE(shows(0.00391f, 5 / 1023.0f)) << "would appear";
    EXPECT_FALSE(shows(0.002f, 0.003f)) << "neither is seen";
}

TEST(ExactGaussians, AreWithinTheRangesOfAFile) {
    constexpr float kNan = std::numeric_limits<float>::quiet_NaN(), kInfinite = std::numeric_limits<float>::infinity();
    const pro_exact_gaussian exact = exactOf({{}, {0, kInfinite, kNan}, {3, 0, 0, -4}, 2, {}}, 5);
    EXPECT_EQ(exact.index, 5u);
    EXPECT_FLOAT_EQ(exact.rotation[0], 0.6f);
    EXPECT_FLOAT_EQ(exact.rotation[3], -0.8f);
    EXPECT_EQ(exact.deviation[0], 0x1p-60f);
    EXPECT_EQ(exact.deviation[1], 0x1p60f);
    EXPECT_EQ(exact.deviation[2], 0x1p-60f);
    EXPECT_EQ(exact.opacity, 1.0f);
    for (const float each : {0.0f, kNan, kInfinite})
        EXPECT_EQ(exactOf({{}, {1, 1, 1}, {each, 0, 0, 0}, 0, {}}, 0).rotation[0], 1.0f) << "no rotation";
}

} // namespace
} // namespace pointrt::test

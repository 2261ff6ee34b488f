// SPDX-License-Identifier: Apache-2.0
// The oracle where answers are known in closed form.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>
#include <stdexcept>

#include "tests/gaussians/oracle.h"

namespace pointrt::test {
namespace {

using std::numbers::pi;

constexpr double kExact = 1e-12;
constexpr Double3 kAhead{0, 0, 1};

OracleGaussian ballAt(const Double3& mean, double deviation, double opacity, const Double3& color = {1, 1, 1}) {
    OracleGaussian gaussian;
    gaussian.mean = mean;
    gaussian.deviation = {deviation, deviation, deviation};
    gaussian.opacity = opacity;
    gaussian.color = color;
    return gaussian;
}

std::vector<OracleHit> hitsOf(std::vector<OracleGaussian> gaussians, const OracleRay& ray) {
    return hitsAlong(oracleScene(std::move(gaussians)), ray);
}

/// Composites all Gaussians along the z axis from the origin.
OracleComposite compositeOf(std::vector<OracleGaussian> gaussians, double stop_below = kOracleStop) {
    const OracleScene scene = oracleScene(std::move(gaussians));
    const OracleRay ray;
    return composite(scene, ray, hitsAlong(scene, ray), stop_below);
}

/// The opacity along a ray of the only Gaussian, 0 if it does not count.
double alphaOf(const OracleGaussian& gaussian, const OracleRay& ray) {
    const std::vector<OracleHit> hits = hitsOf({gaussian}, ray);
    return hits.empty() ? 0 : hits[0].alpha;
}

/// A Gaussian whose long axis lies along a unit vector between the x and the y axis.
OracleGaussian needle(double angle, double longest, double width, double opacity) {
    OracleGaussian gaussian = ballAt({}, width, opacity);
    gaussian.deviation[0] = longest;
    gaussian.rotation = {std::cos(angle / 2), 0, 0, std::sin(angle / 2)};
    return gaussian;
}

TEST(Oracle, RayThroughTheCentreMeetsTheOpacity) {
    const std::vector<OracleHit> hits = hitsOf({ballAt({0, 0, 5}, 0.3, 0.7)}, {});
    ASSERT_EQ(hits.size(), 1u);
    EXPECT_NEAR(hits[0].alpha, 0.7, kExact);
    EXPECT_NEAR(hits[0].t, 5, kExact);
    EXPECT_EQ(hits[0].index, 0u);
}

TEST(Oracle, CapsTheOpacity) { EXPECT_EQ(alphaOf(ballAt({0, 0, 5}, 0.3, 1), {}), 0.99); }

TEST(Oracle, OpacityFallsWithTheDistanceOfTheRay) {
    for (const double distance : {0.1, 0.3, 0.5})
        EXPECT_NEAR(alphaOf(ballAt({distance, 0, 5}, 0.2, 0.8), {}),
                    0.8 * std::exp(-distance * distance / (2 * 0.2 * 0.2)), kExact);
}

TEST(Oracle, LeavesOutGaussiansBelowTheLeastOpacity) {
    const double reach = 0.2 * std::sqrt(2 * std::log(255 * 0.8));
    EXPECT_GT(alphaOf(ballAt({reach - 1e-9, 0, 5}, 0.2, 0.8), {}), 0);
    EXPECT_EQ(alphaOf(ballAt({reach + 1e-9, 0, 5}, 0.2, 0.8), {}), 0);
    EXPECT_GT(alphaOf(ballAt({0, 0, 5}, 0.2, 0.004), {}), 0);
    EXPECT_EQ(alphaOf(ballAt({0, 0, 5}, 0.2, 0.0039), {}), 0);
}

TEST(Oracle, CountsPeaksInFrontOfTheOriginAndBeforeTheEnd) {
    const OracleRay ray{{0, 0, 0}, kAhead, 6};
    EXPECT_EQ(hitsOf({ballAt({0, 0, -0.01}, 1, 0.5)}, ray).size(), 0u) << "although the origin is inside";
    EXPECT_EQ(hitsOf({ballAt({0, 0, 0}, 1, 0.5)}, ray).size(), 0u) << "t = 0";
    EXPECT_EQ(hitsOf({ballAt({0, 0, 0.01}, 1, 0.5)}, ray).size(), 1u);
    EXPECT_EQ(hitsOf({ballAt({0, 0, 5.99}, 1, 0.5)}, ray).size(), 1u);
    EXPECT_EQ(hitsOf({ballAt({0, 0, 6}, 1, 0.5)}, ray).size(), 0u);
}

TEST(Oracle, NeedleIsLongAlongItsRotatedAxis) {
    const double angle = 0.6, longest = 2, width = 0.01;
    const OracleGaussian gaussian = needle(angle, longest, width, 0.9);
    const Double3 along{std::cos(angle), std::sin(angle), 0}, across{-std::sin(angle), std::cos(angle), 0};
    const auto alphaBeside = [&](const Double3& axis, double distance) {
        return alphaOf(gaussian, {plus(times(distance, axis), {0, 0, -3}), kAhead});
    };
    EXPECT_NEAR(alphaBeside(along, 1.5), 0.9 * std::exp(-0.5 * std::pow(1.5 / longest, 2)), kExact);
    EXPECT_NEAR(alphaBeside(across, 0.02), 0.9 * std::exp(-0.5 * 4), kExact);
    EXPECT_EQ(alphaBeside(across, 0.1), 0);
}

/// In the plane of the needle, in units of its deviations, the ray is a line that cuts the axis. Its distance from the
/// mean is that of the cut times the sine of the angle between line and axis; its nearest point lies before the cut by
/// the cosine squared.
TEST(Oracle, RayAtAnAngleToANeedlePeaksBeforeItsAxis) {
    const double longest = 2, width = 0.01, cut = 1.5, slope = 0.01, start = cut - 3;
    const double norm = std::hypot(1, slope), scaled_slope = slope / width * longest;
    const double squared_cosine = 1 / (1 + scaled_slope * scaled_slope);
    const OracleRay ray{{start, -3 * slope, 0}, {1 / norm, slope / norm, 0}};
    const std::vector<OracleHit> hits = hitsOf({needle(0, longest, width, 0.9)}, ray);
    ASSERT_EQ(hits.size(), 1u);
    EXPECT_NEAR(hits[0].alpha, 0.9 * std::exp(-0.5 * std::pow(cut / longest, 2) * (1 - squared_cosine)), kExact);
    EXPECT_NEAR(hits[0].t, (cut * (1 - squared_cosine) - start) * norm, kExact);
}

TEST(Oracle, RotationsNeedNotBeNormalised) {
    OracleGaussian gaussian = needle(0.6, 2, 0.01, 0.9);
    const OracleRay ray{{std::cos(0.6), std::sin(0.6), -3}, kAhead};
    const double alpha = alphaOf(gaussian, ray);
    for (double& part : gaussian.rotation) part *= -7;
    EXPECT_NEAR(alphaOf(gaussian, ray), alpha, kExact);
}

TEST(Oracle, RefusesGaussiansWithoutShape) {
    const OracleGaussian good = ballAt({}, 1, 0.5);
    OracleGaussian flat = good, unrotated = good, unplaced = good, opaque = good, harmonic = good;
    flat.deviation[1] = 0;
    unrotated.rotation = {};
    unplaced.mean[2] = std::numeric_limits<double>::quiet_NaN();
    opaque.opacity = 1.5;
    harmonic.harmonics.resize(4);
    for (const OracleGaussian& each : {flat, unrotated, unplaced, opaque, harmonic})
        EXPECT_THROW(oracleScene({good, each}), std::invalid_argument);
}

TEST(Oracle, CompositesFrontToBackInAnyOrderOfTheFile) {
    const OracleGaussian red = ballAt({0, 0, 2}, 0.1, 0.6, {1, 0, 0}), blue = ballAt({0, 0, 3}, 0.1, 0.5, {0, 0, 1});
    for (const bool red_first : {true, false}) {
        const OracleComposite sum = compositeOf(red_first ? std::vector{red, blue} : std::vector{blue, red});
        EXPECT_NEAR(sum.radiance[0], 0.6, kExact);
        EXPECT_NEAR(sum.radiance[2], 0.4 * 0.5, kExact);
        EXPECT_NEAR(sum.transmittance, 0.4 * 0.5, kExact);
        EXPECT_EQ(sum.strongest, red_first ? 0u : 1u);
        EXPECT_EQ(sum.counted, 2u);
    }
}

TEST(Oracle, EqualPeaksAreInTheOrderOfIndices) {
    const OracleGaussian red = ballAt({0, 0, 2}, 0.1, 0.6, {1, 0, 0}), blue = ballAt({0, 0, 2}, 0.1, 0.6, {0, 0, 1});
    const OracleComposite sum = compositeOf({blue, red});
    EXPECT_NEAR(sum.radiance[2], 0.6, kExact);
    EXPECT_NEAR(sum.radiance[0], 0.4 * 0.6, kExact);
    EXPECT_EQ(sum.strongest, 0u);
}

TEST(Oracle, DepthIsWhereHalfIsHidden) {
    const auto at = [](double z, double opacity) { return ballAt({0, 0, z}, 0.1, opacity); };
    EXPECT_NEAR(compositeOf({at(2, 0.3), at(3, 0.3), at(4, 0.9)}).depth, 3, kExact) << "0.7, 0.49, 0.049";
    EXPECT_NEAR(compositeOf({at(2, 0.5), at(3, 0.5)}).depth, 2, kExact) << "half is enough";
    EXPECT_EQ(compositeOf({at(2, 0.3)}).depth, std::numeric_limits<double>::infinity());
}

TEST(Oracle, StrongestHasTheLargestWeightNotTheLargestOpacity) {
    const auto at = [](double z, double opacity) { return ballAt({0, 0, z}, 0.1, opacity); };
    const OracleComposite sum = compositeOf({at(4, 0.9), at(3, 0.5), at(2, 0.4)});
    EXPECT_EQ(sum.strongest, 2u) << "weights 0.4, 0.6 * 0.5 = 0.3, 0.3 * 0.9 = 0.27";
    EXPECT_NEAR(sum.strongest_weight, 0.4, kExact);
    EXPECT_EQ(compositeOf({}).strongest, kNoGaussian);
}

TEST(Oracle, StopsAfterTheGaussianThatHidesTheRest) {
    std::vector<OracleGaussian> layers;
    for (int k = 0; k < 6; ++k) layers.push_back(ballAt({0, 0, 2.0 + k}, 0.1, 0.95));
    const OracleComposite stopped = compositeOf(layers), all = compositeOf(layers, kNeverStop);
    EXPECT_EQ(stopped.counted, 4u) << "0.05, 0.0025, 0.000125, 0.00000625";
    EXPECT_NEAR(stopped.transmittance, std::pow(0.05, 4), 1e-15);
    EXPECT_EQ(all.counted, 6u);
    EXPECT_NEAR(all.transmittance, std::pow(0.05, 6), 1e-15);
    EXPECT_NEAR(all.radiance[0], 1 - all.transmittance, kExact);
}

TEST(Oracle, AQuarterTurnOfTheWorldChangesNothing) {
    OracleGaussian gaussian = needle(0.3, 1, 0.2, 0.8);
    const OracleRay ray{{0.4, 0.1, -3}, unit(Double3{0.05, 0.02, 1})};
    const double alpha = alphaOf(gaussian, ray);
    // x to y, y to -x
    const auto turned = [](const Double3& v) { return Double3{-v[1], v[0], v[2]}; };
    const OracleGaussian other = needle(0.3 + pi / 2, 1, 0.2, 0.8);
    EXPECT_NEAR(alphaOf(other, {turned(ray.origin), turned(ray.direction)}), alpha, kExact);
}

} // namespace
} // namespace pointrt::test

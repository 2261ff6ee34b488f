// SPDX-License-Identifier: Apache-2.0
// Pictures by the oracle: its camera, and that culling changes nothing.
#include <gtest/gtest.h>

#include <cmath>
#include <numeric>
#include <set>
#include <stdexcept>

#include "tests/gaussians/culling.h"
#include "tests/gaussians/nasty_gaussians.h"
#include "tests/gaussians/oracle_picture.h"
#include "tests/gaussians/srgb.h"

namespace pointrt::test {
namespace {

TEST(OracleCamera, RayThroughTheMiddleGoesToTheTarget) {
    const OracleCamera camera = lookAt({{1, 2, 3}, {-2, 0, 1}, {0, 1, 0}, 50}, 64, 48);
    const OracleRay ray = rayThrough(camera, 32, 24);
    EXPECT_NEAR(length(minus(ray.direction, unit(Double3{-3, -2, -2}))), 0, 1e-12);
}

TEST(OracleCamera, FieldOfViewIsVerticalWithXToTheRightAndYDown) {
    const OracleCamera camera = lookAt({{0, 0, 4}, {0, 0, 0}, {0, 1, 0}, 60}, 200, 100);
    const double half = std::tan(30 * 3.14159265358979323846 / 180);
    const auto onPlane = [&](double x, double y) {
        const Double3 direction = rayThrough(camera, x, y).direction;
        return times(1 / -direction[2], direction);
    };
    EXPECT_NEAR(onPlane(100, 0)[1], half, 1e-12) << "upper edge";
    EXPECT_NEAR(onPlane(100, 100)[1], -half, 1e-12);
    EXPECT_NEAR(onPlane(200, 50)[0], 2 * half, 1e-12) << "right edge";
    EXPECT_NEAR(onPlane(0, 50)[0], -2 * half, 1e-12);
}

TEST(OracleCamera, RefusesViewsWithoutADirection) {
    EXPECT_THROW(lookAt({{1, 1, 1}, {1, 1, 1}, {0, 1, 0}, 40}, 8, 8), std::invalid_argument);
    EXPECT_THROW(lookAt({{0, 5, 0}, {0, 0, 0}, {0, 1, 0}, 40}, 8, 8), std::invalid_argument);
    EXPECT_THROW(lookAt({{0, 0, 4}, {0, 0, 0}, {0, 1, 0}, 180}, 8, 8), std::invalid_argument);
}

TEST(OracleCamera, SamplesStepThroughThePixelByThePlasticNumber) {
    const double plastic = 1.32471795724474602596;
    const PixelOffset first = sampleOffset(77, 0, 3);
    for (std::uint32_t sample = 1; sample < 100; ++sample) {
        const PixelOffset at = sampleOffset(77, sample, 3);
        const auto apart = [](double a, double b) { return std::abs(std::remainder(a - b, 1)); };
        EXPECT_LT(apart(at.x, first.x + sample / plastic), 1e-6);
        EXPECT_LT(apart(at.y, first.y + sample / (plastic * plastic)), 1e-6);
        EXPECT_TRUE(at.x >= 0 && at.x < 1 && at.y >= 0 && at.y < 1);
    }
    EXPECT_NE(sampleOffset(78, 0, 3).x, first.x);
    EXPECT_NE(sampleOffset(77, 0, 4).x, first.x);
}

OracleScene ball(double opacity, double deviation, const Double3& color) {
    OracleGaussian gaussian;
    gaussian.deviation = {deviation, deviation, deviation};
    gaussian.opacity = opacity;
    gaussian.color = color;
    return oracleScene({gaussian});
}

TEST(OraclePicture, PixelsShowTheBallOverTheBackground) {
    const OracleCamera camera = lookAt({}, 31, 31); // pixel 15 looks at the centre
    PictureOptions options;
    options.background = {0.2, 0.4, 0.6};
    const OraclePicture picture = renderPicture(ball(0.8, 0.1, {1, 0, 0}), camera, options);
    const Double3 middle = picture.colors[15 * 31 + 15];
    EXPECT_NEAR(middle[0], 0.8 + 0.2 * 0.2, 1e-12);
    EXPECT_NEAR(middle[1], 0.2 * 0.4, 1e-12);
    EXPECT_EQ(picture.colors[0], options.background);
    EXPECT_NEAR(picture.centers[15 * 31 + 15].depth, 4, 1e-12);
    EXPECT_EQ(picture.centers[0].counted, 0u);
}

TEST(OraclePicture, SeveralSamplesAverageLinearLight) {
    const OracleCamera camera = lookAt({}, 1, 1);
    const OracleScene scene = ball(0.8, 0.3, {1, 1, 1});
    PictureOptions options;
    options.spp = 3;
    double light = 0;
    for (std::uint32_t sample = 0; sample < 3; ++sample) {
        const PixelOffset at = sampleOffset(0, sample, 0);
        const OracleRay ray = rayThrough(camera, at.x, at.y);
        light += linearFromSrgb(composite(scene, ray, hitsAlong(scene, ray)).radiance[0]) / 3;
    }
    EXPECT_NEAR(linearFromSrgb(renderPicture(scene, camera, options).colors[0][0]), light, 1e-12);
}

/// Both pictures must be equal bit for bit.
void expectSamePictures(const OracleScene& scene, const OracleCamera& camera, PictureOptions options = {}) {
    const OraclePicture culled = renderPicture(scene, camera, options);
    options.culls = false;
    const OraclePicture all = renderPicture(scene, camera, options);
    EXPECT_TRUE(culled.colors == all.colors);
    EXPECT_TRUE(culled.centers == all.centers);
}

TEST(Culling, ChangesNoPixelOfRandomGaussians) {
    const OracleView view{{1, 2, 3}, {0, 0.1, 0}, {0, 1, 0.2}, 40};
    // the last tiles are partial
    expectSamePictures(oracleScene(makeGaussians("random", 2000)), lookAt(view, 150, 100));
}

class CullingOfKinds : public testing::TestWithParam<std::string> {};

TEST_P(CullingOfKinds, ChangesNoPixel) {
    const OracleScene scene = oracleScene(makeGaussians(GetParam(), 400));
    expectSamePictures(scene, lookAt({}, 49, 35));
    expectSamePictures(scene, lookAt({{0.01, 0, 0.02}, {1, 0.2, 0}, {0, 0, 1}, 150}, 49, 35));
    expectSamePictures(scene, lookAt({{300, 400, -200}, {0, 0, 0}, {0, 1, 0}, 0.3}, 49, 35));
}

INSTANTIATE_TEST_SUITE_P(Each, CullingOfKinds, testing::ValuesIn(gaussianKinds()),
                         [](const auto& each) { return each.param; });

TEST(Culling, ChangesNoPixelOfManySamples) {
    PictureOptions options;
    options.spp = 4;
    expectSamePictures(oracleScene(makeGaussians("needles", 300)), lookAt({}, 49, 35), options);
}

/// Whether a rectangle sees a ball off its upper left corner, which touches the corner's ray at this share of its
/// reach.
bool seesBallBesideCorner(const OracleCamera& camera, PixelRectangle r, double share) {
    const Double3 corner = rayThrough(camera, r.left, r.top).direction;
    const Double3 middle = rayThrough(camera, 0.5 * (r.left + r.right), 0.5 * (r.top + r.bottom)).direction;
    const Double3 outwards = unit(minus(corner, times(1 / dot(corner, middle), middle)));
    const Double3 across = unit(minus(outwards, times(dot(outwards, corner), corner)));
    OracleGaussian ball;
    ball.deviation = {0.1, 0.1, 0.1};
    ball.opacity = 0.5;
    const double reach = 0.1 * std::sqrt(2 * std::log(255 * 0.5));
    ball.mean = plus(camera.eye, plus(times(3, corner), times(share * reach, across)));
    const OracleScene scene = oracleScene({ball});
    return !seenThrough(camera, r, ellipsoidsFrom(camera.eye, scene), std::vector{0u}).empty();
}

TEST(Culling, SeesBallsThatTouchACorner) {
    const OracleCamera camera = lookAt({{0, 0, 4}, {0, 0, 0}, {0, 1, 0}, 90}, 64, 48);
    EXPECT_TRUE(seesBallBesideCorner(camera, {24, 16, 40, 32}, 1 - 1e-6));
    EXPECT_FALSE(seesBallBesideCorner(camera, {24, 16, 40, 32}, 1.01)) << "in the middle all corners are on the cone";
    EXPECT_TRUE(seesBallBesideCorner(camera, {0, 32, 64, 48}, 1 - 1e-6));
    EXPECT_TRUE(seesBallBesideCorner(camera, {0, 0, 16, 16}, 1 - 1e-6));
}

/// Gaussians that count along some ray through a grid twice as fine as the pixels.
std::size_t hitThrough(const OracleScene& scene, const OracleCamera& camera, PixelRectangle r) {
    std::set<std::uint32_t> hit;
    for (std::uint32_t y = 2 * r.top; y <= 2 * r.bottom; ++y)
        for (std::uint32_t x = 2 * r.left; x <= 2 * r.right; ++x)
            for (const OracleHit& each : hitsAlong(scene, rayThrough(camera, 0.5 * x, 0.5 * y))) hit.insert(each.index);
    return hit.size();
}

TEST(Culling, LeavesFewGaussiansThatNoRayHits) {
    const OracleScene scene = oracleScene(makeGaussians("random", 2000));
    const OracleCamera camera = lookAt({}, 512, 512);
    const PixelRectangle tile{256, 256, 272, 272};
    std::vector<std::uint32_t> all(2000);
    std::iota(all.begin(), all.end(), 0u);
    const std::size_t seen = seenThrough(camera, tile, ellipsoidsFrom(camera.eye, scene), all).size();
    const std::size_t hit = hitThrough(scene, camera, tile);
    EXPECT_GE(seen, hit);
    EXPECT_LT(seen, hit + hit / 2) << "131 and 99";
}

} // namespace
} // namespace pointrt::test

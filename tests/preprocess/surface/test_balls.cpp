// SPDX-License-Identifier: Apache-2.0
// Balls: which points become one, and how large.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <numbers>
#include <numeric>

#include "tests/preprocess/surface/shapes.h"

namespace pointrt::test {
namespace {

/// Points spread uniformly in a cube.
Shape scatter(std::size_t count, const Vec3d& low, double edge) {
    Random random(41);
    Shape shape;
    while (shape.positions.size() < count) {
        const double x = uniform(random), y = uniform(random), z = uniform(random);
        shape.add(low + edge * Vec3d(x, y, z), Vec3d::UnitZ());
    }
    return shape;
}

Splats estimateAs(SplatShape splat, Cloud cloud, SurfaceReport& report) {
    SurfaceOptions options;
    options.splat = splat;
    return estimateSplats(std::move(cloud), options, report);
}

Splats estimateAs(SplatShape splat, Cloud cloud) {
    SurfaceReport report;
    return estimateAs(splat, std::move(cloud), report);
}

bool isBall(const Splats& splats, std::size_t i) { return splats.normals[i] == Vec3f::Zero(); }

std::size_t ballsOf(const Splats& splats) {
    std::size_t count = 0;
    for (std::size_t i = 0; i < splats.normals.size(); ++i) count += isBall(splats, i);
    return count;
}

/// The median distance to the three nearest splats.
float typicalDistance(const Splats& splats, std::size_t splat) {
    std::vector<float> distances;
    for (std::size_t i = 0; i < splats.positions.size(); ++i)
        if (i != splat) distances.push_back((splats.positions[i] - splats.positions[splat]).norm());
    std::nth_element(distances.begin(), distances.begin() + 1, distances.end());
    return distances[1];
}

/// The median of that over a splat and its neighbours.
float typicalDistanceAround(const Splats& splats, std::size_t splat) {
    const auto distanceTo = [&](std::size_t i) { return (splats.positions[i] - splats.positions[splat]).norm(); };
    std::vector<std::size_t> nearest(splats.positions.size());
    std::iota(nearest.begin(), nearest.end(), std::size_t{0});
    const auto end = nearest.begin() + 1 + SurfaceOptions().neighbors;
    std::partial_sort(nearest.begin(), end, nearest.end(),
                      [&](std::size_t a, std::size_t b) { return distanceTo(a) < distanceTo(b); });
    std::vector<float> distances;
    for (auto each = nearest.begin(); each != end; ++each) distances.push_back(typicalDistance(splats, *each));
    std::sort(distances.begin(), distances.end());
    return distances[distances.size() / 2];
}

void expectSameSplats(const Splats& a, const Splats& b) {
    EXPECT_EQ(a.positions, b.positions);
    EXPECT_EQ(a.normals, b.normals);
    EXPECT_EQ(a.radii, b.radii);
    EXPECT_EQ(a.noise, b.noise);
}

TEST(BallChoice, NoiseInSpaceBecomesBallsThatTouch) {
    SurfaceReport report;
    const Splats splats = estimateAs(SplatShape::kAuto, scatter(6000, Vec3d(100, -50, 3), 2).cloud(), report);
    EXPECT_EQ(ballsOf(splats), splats.positions.size());
    EXPECT_EQ(report.balls, splats.positions.size());
    EXPECT_GT(splats.positions.size(), 5900u); // the rest are outliers
    for (std::size_t i = 0; i < splats.positions.size(); i += 200)
        EXPECT_NEAR(splats.radii[i], 0.5f * typicalDistanceAround(splats, i), 1e-4f * splats.radii[i]);
}

// As in pictures of mesh samples: the nearest neighbour of one point is 3.6 times as far away as that of another.
TEST(BallChoice, RandomSamplesOfASurfaceBecomeBallsAlike) {
    std::vector<float> radii = estimateAs(SplatShape::kBall, randomSphere(2048).cloud()).radii;
    ASSERT_EQ(radii.size(), 2048u);
    std::sort(radii.begin(), radii.end());
    EXPECT_LT(radii[radii.size() * 19 / 20], 2 * radii[radii.size() / 20]);
}

TEST(BallChoice, SurfacesStayDiscs) {
    Shape noisy = jitteredPlane(90, 0, Vec3d::UnitZ(), 7);
    addNoise(noisy, 0.5 / 90); // half a spacing
    for (const Shape& shape : {gridPlane(80), noisy, gridCube(40), randomTorus(6000), thinPlate(60, 1)})
        expectSameSplats(estimateAs(SplatShape::kAuto, shape.cloud()), estimateAs(SplatShape::kDisc, shape.cloud()));
}

/// A plane of 10,000 points with a crown of 5,000 above it.
TEST(BallChoice, CrownsBecomeBallsAndTheGroundDoesNot) {
    Shape both = gridPlane(100);
    const std::size_t ground = both.positions.size();
    both.append(scatter(5000, Vec3d(0, 0, 1), 1));
    const Splats splats = estimateAs(SplatShape::kAuto, both.cloud()),
                 discs = estimateAs(SplatShape::kDisc, both.cloud());
    ASSERT_EQ(splats.positions, discs.positions);
    std::size_t balls = 0;
    for (std::size_t i = 0; i < splats.positions.size(); ++i) {
        if (!isBall(splats, i)) {
            EXPECT_EQ(splats.radii[i], discs.radii[i]);
            continue;
        }
        ++balls;
        EXPECT_GE(splats.input_index[i], ground);
        // on average, a disc shows half its area
        EXPECT_NEAR(splats.radii[i] / discs.radii[i], 1 / std::numbers::sqrt2_v<float>, 1e-5f);
    }
    EXPECT_GT(balls, 4900u);
}

/// Waves 16 spacings long and 4 high, and noise of 0.7 spacings. Where they bend, points look scattered: without the
/// second look after smoothing, 1,700 become balls.
TEST(BallChoice, FoldsInNoiseStayDiscs) {
    constexpr int kEdge = 100; // points
    constexpr double kWave = 2 * std::numbers::pi / 16, kHeight = 4;
    Random random(1);
    Shape folds;
    for (int i = 0; i < kEdge * kEdge; ++i) {
        const double x = i % kEdge + uniform(random), y = double(i / kEdge) + uniform(random);
        const Vec3d normal(-kHeight * kWave * std::cos(kWave * x), 0, 1);
        folds.add(Vec3d(x, y, kHeight * std::sin(kWave * x)), normal.normalized());
    }
    addNoise(folds, 0.7);
    EXPECT_LT(ballsOf(estimateAs(SplatShape::kAuto, folds.cloud())), 20u);
}

/// Fewer than one in a hundred is accepted: edges and strays of scans look like that.
TEST(BallChoice, AFewScatteredPointsStayDiscs) {
    Shape shape = gridPlane(100);
    shape.append(scatter(90, Vec3d(0.4, 0.4, 0.1), 0.1));
    EXPECT_EQ(ballsOf(estimateAs(SplatShape::kAuto, shape.cloud())), 0u);
}

TEST(BallChoice, PointsWithNormalsStayDiscs) {
    Cloud cloud = scatter(6000, Vec3d::Zero(), 1).cloud();
    cloud.normals.assign(cloud.positions.size(), Vec3f::UnitX());
    EXPECT_EQ(ballsOf(estimateAs(SplatShape::kAuto, cloud)), 0u);
    SurfaceOptions ignoring;
    ignoring.splat = SplatShape::kAuto;
    ignoring.normals = NormalSource::kEstimate;
    SurfaceReport report;
    EXPECT_GT(ballsOf(estimateSplats(std::move(cloud), ignoring, report)), 5900u);
}

/// 1000 points of a plate a tenth of its width thick, whose neighbourhoods reach both sides, of a sphere, and of a
/// torus.
TEST(BallChoice, SparseThinPartsBecomeBalls) {
    Random random(8);
    Shape plate;
    for (int i = 0; i < 1000; ++i) {
        const double x = uniform(random), y = uniform(random);
        plate.add(Vec3d(x, y, i % 2 ? 0.05 : -0.05), Vec3d::UnitZ());
    }
    const Splats splats = estimateAs(SplatShape::kAuto, plate.cloud());
    EXPECT_EQ(ballsOf(splats), 1000u);
    for (std::size_t i = 0; i < splats.positions.size(); ++i) // smoothing would move them
        EXPECT_EQ(splats.positions[i], plate.positions[splats.input_index[i]]);
    EXPECT_EQ(ballsOf(estimateAs(SplatShape::kAuto, randomSphere(1000).cloud())), 0u);
    EXPECT_EQ(ballsOf(estimateAs(SplatShape::kAuto, randomTorus(1000).cloud())), 0u);
}

TEST(BallChoice, AllBecomeBallsOnDemand) {
    SurfaceReport report;
    Cloud cloud = gridPlane(50).cloud();
    cloud.normals.assign(cloud.positions.size(), Vec3f::UnitZ());
    const Splats splats = estimateAs(SplatShape::kBall, std::move(cloud), report);
    EXPECT_EQ(ballsOf(splats), 2500u);
    EXPECT_EQ(report.balls, 2500u);
    EXPECT_TRUE(splats.oriented);
    EXPECT_TRUE(splats.noise.empty());
    for (const float radius : splats.radii) EXPECT_NEAR(radius, 0.01f, 1e-6f); // half of 1/50
}

TEST(BallChoice, StraysStaySmall) {
    Shape shape = gridPlane(50);
    // most of a neighbourhood of 16: fewer would become as large as their surroundings
    for (int i = 0; i < 12; ++i) shape.add(Vec3d(3 + i, 0, 0), Vec3d::UnitZ());
    SurfaceOptions options;
    options.splat = SplatShape::kBall;
    options.remove_outliers = false;
    const Splats splats = estimate(shape.cloud(), options);
    EXPECT_NEAR(*std::max_element(splats.radii.begin(), splats.radii.end()), 0.03f, 1e-5f); // three times the median
}

TEST(BallChoice, GivenRadiiStay) {
    Cloud cloud = gridPlane(50).cloud();
    cloud.radii.assign(cloud.positions.size(), 0);
    cloud.radii[7] = 0.4f;
    const Splats splats = estimateAs(SplatShape::kBall, std::move(cloud));
    for (std::size_t i = 0; i < splats.radii.size(); ++i)
        EXPECT_NEAR(splats.radii[i], splats.input_index[i] == 7 ? 0.4f : 0.01f, 1e-6f);
}

TEST(BallChoice, RadiusScaleScalesBalls) {
    SurfaceOptions options;
    options.splat = SplatShape::kBall;
    options.radius_scale = 2;
    for (const float radius : estimate(gridPlane(50).cloud(), options).radii) EXPECT_NEAR(radius, 0.02f, 1e-6f);
}

} // namespace
} // namespace pointrt::test

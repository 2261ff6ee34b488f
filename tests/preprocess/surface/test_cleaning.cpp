// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include "preprocess/surface/noise.h"
#include "tests/preprocess/surface/shapes.h"
#include "tests/support/mean.h"

namespace pointrt::test {
namespace {

struct Cleaned {
    Splats splats;
    SurfaceReport report;
};

Cleaned cleaned(Cloud cloud, double strength = 1) {
    Cleaned result;
    SurfaceOptions options;
    options.clean = strength;
    result.splats = estimateSplats(std::move(cloud), options, result.report);
    return result;
}

/// Root mean square.
template <typename Distance>
double rms(const Splats& splats, const Distance& distance) {
    double sum = 0;
    for (const Vec3f& p : splats.positions) sum += distance(p) * distance(p);
    return std::sqrt(sum / double(splats.positions.size()));
}

/// 40,000 points on the unit sphere have a spacing of sqrt(4 pi / 40,000).
constexpr double kSphereSpacing = 0.0177;

Shape noisySphere(double spacings) {
    Shape shape = randomSphere(40'000);
    addNoise(shape, spacings * kSphereSpacing);
    return shape;
}

TEST(Noise, IsMeasuredAsAdded) {
    for (const double spacings : {0.1, 0.3, 0.5}) {
        const Cleaned result = cleaned(noisySphere(spacings).cloud());
        ASSERT_EQ(result.report.noise.size(), 1u);
        EXPECT_NEAR(result.report.noise[0], spacings, 0.2 * spacings);
    }
}

TEST(Noise, IsMeasuredPerScan) {
    Shape shape = noisySphere(0.3);
    const std::size_t first = shape.positions.size();
    shape.append(randomSphere(40'000, Vec3d(3, 0, 0)));
    Cloud cloud = shape.cloud();
    cloud.scans = {{"noisy", {}, 0}, {"clean", {}, first}};
    const Cleaned result = cleaned(std::move(cloud));
    ASSERT_EQ(result.report.noise.size(), 2u);
    EXPECT_NEAR(result.report.noise[0], 0.3, 0.06);
    EXPECT_LT(result.report.noise[1], kCleanNoise);
    for (std::size_t i = 0; i < result.splats.positions.size(); ++i)
        if (result.splats.input_index[i] >= first) {
            ASSERT_EQ(result.splats.positions[i], shape.positions[result.splats.input_index[i]]);
        }
}

TEST(Cleaning, CleanInputStaysBitForBit) {
    for (const Shape& shape : {randomSphere(20'000), randomTorus(20'000), gridCube(40), randomPlane(10'000)}) {
        const Cleaned with = cleaned(shape.cloud()), without = cleaned(shape.cloud(), 0);
        EXPECT_EQ(with.splats.positions, without.splats.positions);
        EXPECT_EQ(with.splats.normals, without.splats.normals);
        EXPECT_EQ(with.splats.radii, without.splats.radii);
        EXPECT_TRUE(with.splats.noise.empty());
        EXPECT_EQ(with.report.clean_moved, 0u);
    }
}

/// 400 points with a noise of 0.3 spacings: too few to distinguish noise from shape, unless the noise was decided
/// before.
TEST(Cleaning, FewPointsOfANoisyScanAreCleaned) {
    Shape patch = randomPlane(400);
    addNoise(patch, 0.3 / 20);
    SurfaceDecisions decided;
    const auto heights = [&] {
        SurfaceReport report;
        return rms(estimateSplats(patch.cloud(), {}, report, {}, decided),
                   [](const Vec3f& p) { return double(p.z()); });
    };
    const double before = heights();
    EXPECT_NEAR(before, 0.3 / 20, 0.1 / 20);
    decided.statistics.noise = {0.3f};
    EXPECT_LT(heights(), 0.5 * before);
}

TEST(Cleaning, OffMovesNothing) {
    const Shape shape = noisySphere(0.4);
    const Cleaned result = cleaned(shape.cloud(), 0);
    for (std::size_t i = 0; i < result.splats.positions.size(); ++i)
        ASSERT_EQ(result.splats.positions[i], shape.positions[result.splats.input_index[i]]);
}

TEST(Cleaning, PointsWithGivenRadiiStay) {
    // beside a sphere with a noise of 0.2 spacings, one of twice as many Gaussians with a noise of 0.5
    Shape shape = noisySphere(0.2);
    const std::size_t first = shape.positions.size();
    Shape gaussians = randomSphere(80'000, Vec3d(3, 0, 0));
    addNoise(gaussians, 0.5 * kSphereSpacing);
    shape.append(gaussians);
    Cloud cloud = shape.cloud();
    cloud.radii.assign(shape.positions.size(), 0);
    std::fill(cloud.radii.begin() + std::ptrdiff_t(first), cloud.radii.end(), 0.01f);
    const Cleaned result = cleaned(std::move(cloud));
    ASSERT_EQ(result.report.noise.size(), 1u);
    EXPECT_NEAR(result.report.noise[0], 0.2, 0.04);
    EXPECT_GT(result.report.clean_moved, 39'000u);
    std::size_t stayed = 0;
    for (std::size_t i = 0; i < result.splats.positions.size(); ++i) {
        const std::size_t point = result.splats.input_index[i];
        if (point < first) continue;
        ++stayed;
        ASSERT_EQ(result.splats.positions[i], shape.positions[point]);
        ASSERT_EQ(result.splats.noise[i], 0);
    }
    EXPECT_EQ(stayed + result.report.outliers_removed, 80'000u);
}

TEST(Cleaning, CloudsOfGaussiansStayBitForBit) {
    Cloud cloud = noisySphere(0.4).cloud();
    cloud.radii.assign(cloud.positions.size(), 0.01f);
    const Cleaned with = cleaned(cloud), without = cleaned(cloud, 0);
    EXPECT_EQ(with.report.noise, std::vector<float>{0});
    EXPECT_EQ(with.splats.positions, without.splats.positions);
    EXPECT_EQ(with.splats.normals, without.splats.normals);
    EXPECT_EQ(with.splats.radii, without.splats.radii);
}

TEST(Cleaning, KeepsNormalsWithKeep) {
    const Shape shape = noisySphere(0.3);
    Cloud cloud = shape.cloud();
    cloud.normals = shape.normals;
    SurfaceOptions options;
    options.normals = NormalSource::kKeep;
    SurfaceReport report;
    const Splats splats = estimateSplats(std::move(cloud), options, report);
    EXPECT_GT(report.clean_moved, 39'000u);
    for (std::size_t i = 0; i < splats.positions.size(); ++i)
        ASSERT_LT((splats.normals[i] - shape.normals[splats.input_index[i]]).norm(), 1e-5f);
}

TEST(Cleaning, RestoresANoisySphere) {
    const Shape shape = noisySphere(0.3);
    const Cleaned before = cleaned(shape.cloud(), 0), after = cleaned(shape.cloud());
    const auto height = [](const Vec3f& p) { return double(p.norm()) - 1; };
    EXPECT_LT(rms(after.splats, height), 0.25 * rms(before.splats, height));
    EXPECT_LT(meanOf(normalErrors(after.splats, shape)), 2.0);
    EXPECT_LT(after.report.clean_dropped, 20u);
    ASSERT_EQ(after.splats.noise.size(), after.splats.positions.size());
    std::vector<float> left = after.splats.noise;
    std::nth_element(left.begin(), left.begin() + 20'000, left.end());
    EXPECT_LT(left[20'000], 0.12 * kSphereSpacing);
}

TEST(Cleaning, SheetsThreeSpacingsApartKeepTheirDistance) {
    constexpr int kSteps = 200;
    Shape shape = thinPlate(kSteps, 3);
    addNoise(shape, 0.2 / kSteps);
    const Cleaned result = cleaned(shape.cloud());
    double sum[2] = {0, 0}, count[2] = {0, 0};
    for (std::size_t i = 0; i < result.splats.positions.size(); ++i) {
        const bool top = result.splats.input_index[i] >= kSteps * kSteps;
        sum[top] += double(result.splats.positions[i].z());
        count[top] += 1;
    }
    EXPECT_NEAR(sum[1] / count[1] - sum[0] / count[0], 3.0 / kSteps, 0.05 * 3 / kSteps);
}

/// Distance from the surface of [0, 1]^3.
double offCube(const Vec3f& p) {
    const Vec3d q = p.cast<double>(), outside = (q - Vec3d::Constant(0.5)).cwiseAbs() - Vec3d::Constant(0.5);
    return outside.maxCoeff() < 0 ? -outside.maxCoeff() : outside.cwiseMax(0).norm();
}

TEST(Cleaning, EdgesOfANoisyCubeStayWithinHalfARadius) {
    constexpr int kSteps = 100;
    Shape shape = gridCube(kSteps);
    addNoise(shape, 0.2 / kSteps);
    const Cleaned result = cleaned(shape.cloud());
    std::vector<float> radii = result.splats.radii;
    std::nth_element(radii.begin(), radii.begin() + std::ptrdiff_t(radii.size() / 2), radii.end());
    const double radius = double(radii[radii.size() / 2]);
    std::vector<double> off;
    for (const Vec3f& p : result.splats.positions) off.push_back(offCube(p));
    std::sort(off.begin(), off.end());
    EXPECT_LT(off[off.size() / 2], 0.05 / kSteps);
    EXPECT_LT(off[off.size() * 99 / 100], 0.5 * radius);
}

TEST(Cleaning, DoesNotDependOnThreads) {
    const Shape shape = noisySphere(0.3);
    Splats one;
    {
        const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, 1);
        one = cleaned(shape.cloud()).splats;
    }
    const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, 3);
    const Splats three = cleaned(shape.cloud()).splats;
    EXPECT_EQ(one.positions, three.positions);
    EXPECT_EQ(one.normals, three.normals);
    EXPECT_EQ(one.radii, three.radii);
    EXPECT_EQ(one.noise, three.noise);
}

/// A terrain sampled too sparsely for its houses: what looks like noise there is shape, as the ground is quiet.
TEST(Cleaning, SparseHousesAreNotNoise) {
    Random random(41);
    Shape shape;
    for (int i = 0; i < 1600; ++i) {
        const double x = 400 * uniform(random), y = 400 * uniform(random);
        const bool built = x > 150 && uniform(random) < 0.4; // houses and trees narrower than the spacing of 10
        shape.add(Vec3d(x, y, 0.01 * gaussian(random) + (built ? 20 * uniform(random) : 0)), Vec3d::UnitZ());
    }
    SurfaceReport report;
    const Splats splats = estimateSplats(shape.cloud(), {}, report);
    EXPECT_EQ(report.clean_moved, 0u);
    for (std::size_t i = 0; i < splats.positions.size(); ++i) {
        ASSERT_LT(splats.input_index[i], shape.positions.size());
        EXPECT_EQ(splats.positions[i], shape.positions[splats.input_index[i]]);
    }
}

} // namespace
} // namespace pointrt::test

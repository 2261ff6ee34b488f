// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <cstdlib>
#include <set>

#include "tests/preprocess/surface/shapes.h"

namespace pointrt::test {
namespace {

TEST(Duplicates, TheFirstStaysWithItsColor) {
    Shape shape = randomSphere(500);
    Cloud cloud = shape.cloud();
    cloud.positions.insert(cloud.positions.end(), shape.positions.begin(), shape.positions.begin() + 100);
    for (std::size_t i = 0; i < cloud.positions.size(); ++i)
        cloud.colors.push_back({i < 500 ? Rgb8::value_type(1) : Rgb8::value_type(2), 0, 0});
    SurfaceReport report;
    const Splats splats = estimateSplats(std::move(cloud), {}, report);
    EXPECT_EQ(report.duplicates_removed, 100u);
    ASSERT_EQ(splats.positions.size(), 500u);
    for (std::size_t i = 0; i < 500; ++i) {
        EXPECT_LT(splats.input_index[i], 500u);
        EXPECT_EQ(splats.colors[i][0], 1);
    }
}

TEST(Duplicates, NegativeZeroEqualsZero) {
    Cloud cloud;
    cloud.positions = {{0, 0, 0}, {-0.f, 0, -0.f}, {1, 0, 0}, {0, 1, 0}, {1, 1, 0}};
    SurfaceReport report;
    const Splats splats = estimateSplats(std::move(cloud), {}, report);
    EXPECT_EQ(report.duplicates_removed, 1u);
    EXPECT_EQ(std::count(splats.input_index.begin(), splats.input_index.end(), 0u), 1);
}

TEST(Positions, ComeBackBitForBit) {
    Shape shape = randomSphere(1000, Vec3d(-371, 12.5, 9000), 250);
    const Splats splats = estimate(shape.cloud());
    std::set<std::uint32_t> seen(splats.input_index.begin(), splats.input_index.end());
    EXPECT_EQ(seen.size(), splats.positions.size());
    for (std::size_t i = 0; i < splats.positions.size(); ++i)
        EXPECT_EQ(splats.positions[i], shape.positions[splats.input_index[i]]);
}

/// A sphere of 20,000 points (spacing 0.025) with single outliers and a clump.
struct SphereWithOutliers {
    Shape shape = randomSphere(20'000);
    std::size_t outliers = 0;

    void addOutlier(const Vec3d& position) {
        shape.add(position, Vec3d::UnitZ());
        ++outliers;
    }
    SphereWithOutliers() {
        for (const Vec3d& p : {Vec3d(2, 0, 0), Vec3d(0, 0.5, 0), Vec3d(0, -3, 1), Vec3d(0, 0, 1.5)}) addOutlier(p);
        for (int i = 0; i < 12; ++i)
            addOutlier(Vec3d(-2 + 0.01 * (i % 4), 0.01 * (i / 4), 0)); // a patch of another scan
    }
};

TEST(Outliers, AreRemovedAndTheSurfaceStays) {
    SphereWithOutliers sphere;
    SurfaceReport report;
    const Splats splats = estimateSplats(sphere.shape.cloud(), {}, report);
    EXPECT_EQ(report.outliers_removed, sphere.outliers);
    ASSERT_EQ(splats.positions.size(), 20'000u);
    for (const std::uint32_t index : splats.input_index) EXPECT_LT(index, 20'000u);
    EXPECT_LT(normalErrors(splats, sphere.shape).back(), 5) << "neighbour lists are rebuilt";
}

/// A sphere of 100,000 points with 1% floaters in its bounding box.
TEST(Outliers, FloatersAreRemovedAndTheSurfaceStays) {
    constexpr std::size_t kSurface = 100'000, kFloaters = 1000;
    Shape shape = randomSphere(kSurface);
    Random random(21);
    std::size_t isolated = 0, beside = 0;
    const auto isIsolated = [](const Vec3f& p) { return std::abs(p.norm() - 1) > 0.1; }; // nine spacings of the surface
    const auto isBeside = [](const Vec3f& p) {
        return std::abs(p.norm() - 1) > 0.045 && std::abs(p.norm() - 1) <= 0.1;
    };
    for (std::size_t i = 0; i < kFloaters; ++i) {
        const double x = uniform(random), y = uniform(random), z = uniform(random);
        shape.add(2 * Vec3d(x, y, z) - Vec3d::Ones(), Vec3d::UnitZ());
        isolated += isIsolated(shape.positions.back());
        beside += isBeside(shape.positions.back());
    }
    SurfaceReport report;
    const Splats splats = estimateSplats(shape.cloud(), {}, report);
    std::size_t surface_left = 0, isolated_left = 0, beside_left = 0;
    for (const std::uint32_t index : splats.input_index) {
        surface_left += index < kSurface;
        isolated_left += index >= kSurface && isIsolated(shape.positions[index]);
        beside_left += index >= kSurface && isBeside(shape.positions[index]);
    }
    EXPECT_GE(surface_left, kSurface - kSurface / 10'000); // measured: all
    EXPECT_LT(isolated_left, isolated / 20);               // measured: 28 of 713
    EXPECT_LT(beside_left, beside / 7);                    // measured: 19 of 147
}

/// A part of a cloud with so many floaters that they would determine the 95% quantile.
TEST(Outliers, OfAPartAreJudgedByTheLargerCloud) {
    constexpr std::size_t kSurface = 5000, kFloaters = 1000;
    Shape shape = randomSphere(kSurface);
    Random random(22);
    for (std::size_t i = 0; i < kFloaters; ++i) {
        const double x = uniform(random), y = uniform(random), z = uniform(random);
        shape.add(40 * Vec3d(x, y, z) - 20 * Vec3d::Ones(), Vec3d::UnitZ());
    }
    SurfaceReport alone, part;
    estimateSplats(shape.cloud(), {}, alone);
    EXPECT_LT(alone.outliers_removed, kFloaters / 10);
    SurfaceDecisions decided;
    decided.statistics.common_reach = 0.12f; // 16 neighbours of a point of the sphere
    estimateSplats(shape.cloud(), {}, part, {}, decided);
    EXPECT_GT(part.outliers_removed, kFloaters * 9 / 10);
    EXPECT_LE(part.outliers_removed, kFloaters);
}

/// 300 points of a sphere and 500 floaters: too few points by themselves, and most are floaters.
TEST(Outliers, AreRemovedFromSmallPartsOfALargerCloud) {
    Shape shape = randomSphere(300);
    Random random(23);
    for (int i = 0; i < 500; ++i) {
        const double x = uniform(random), y = uniform(random), z = uniform(random);
        shape.add(40 * Vec3d(x, y, z) - 20 * Vec3d::Ones(), Vec3d::UnitZ());
    }
    SurfaceReport alone, part;
    estimateSplats(shape.cloud(), {}, alone);
    EXPECT_EQ(alone.outliers_removed, 0u);
    SurfaceDecisions decided;
    decided.statistics.common_reach = 0.5f; // 16 neighbours of a point of the sphere
    estimateSplats(shape.cloud(), {}, part, {}, decided);
    EXPECT_GT(part.outliers_removed, 450u);
    EXPECT_LE(part.outliers_removed, 500u);
}

TEST(Outliers, StayIfRemovalIsOff) {
    SphereWithOutliers sphere;
    SurfaceOptions options;
    options.remove_outliers = false;
    EXPECT_EQ(estimate(sphere.shape.cloud(), options).positions.size(), 20'000 + sphere.outliers);
}

TEST(Outliers, SmallCloudsKeepAllPoints) {
    Shape shape = randomSphere(900);
    shape.add(Vec3d(50, 0, 0), Vec3d::UnitX());
    EXPECT_EQ(estimate(shape.cloud()).positions.size(), 901u);
}

TEST(Outliers, SparseSurfaceBesideDenseOneStays) {
    Shape shape = gridPlane(100); // 100 times as dense as the part to its right
    for (int i = 0; i < 40; ++i)
        for (int j = 0; j < 10; ++j) shape.add(Vec3d(1 + (i + 0.5) / 10, (j + 0.5) / 10, 0), Vec3d::UnitZ());
    SurfaceReport report;
    estimateSplats(shape.cloud(), {}, report);
    EXPECT_EQ(report.outliers_removed, 0u);
}

/// Terrain whose density varies: clumps 50 times as dense as the rest, which most neighbours of points beside them are
/// in.
TEST(Outliers, SparseSurfaceAroundClumpsStays) {
    Random random(33);
    Shape shape;
    const auto add = [&](double x, double y) {
        shape.add(Vec3d(x, y, 2 * std::sin(x / 9) * std::cos(y / 7) + 0.02 * gaussian(random)), Vec3d::UnitZ());
    };
    for (int i = 0; i < 5000; ++i) {
        const double x = 60 * uniform(random), y = 60 * uniform(random);
        add(x, y);
    }
    for (int clump = 0; clump < 30; ++clump) {
        const double x = 3 + 54 * uniform(random), y = 3 + 54 * uniform(random);
        for (int i = 0; i < 500; ++i) {
            const double dx = gaussian(random), dy = gaussian(random);
            add(x + 0.05 * dx, y + 0.05 * dy);
        }
    }
    SurfaceReport report;
    estimateSplats(shape.cloud(), {}, report);
    EXPECT_LT(report.outliers_removed, 75u); // 1.5% of the sparse points; without the rule hundreds
}

TEST(Outliers, SparseRoundSurfaceBesideDenseOneStays) {
    Shape shape = gridPlane(100);
    shape.append(randomSphere(400, Vec3d(0.5, 0.5, 3)));
    SurfaceReport report;
    estimateSplats(shape.cloud(), {}, report);
    EXPECT_EQ(report.outliers_removed, 0u);
}

TEST(Outliers, SparseLineBesideDenseSurfaceStays) {
    Shape shape = gridPlane(100);
    for (int i = 0; i < 200; ++i) shape.add(Vec3d(0.1 * i, 0.5, 5), Vec3d::UnitZ());
    SurfaceReport report;
    estimateSplats(shape.cloud(), {}, report);
    EXPECT_EQ(report.outliers_removed, 0u);
}

TEST(Outliers, ADistantOneDoesNotChangeTheSurface) {
    Shape shape = randomSphere(20'000);
    Cloud cloud = shape.cloud();
    const Splats alone = estimate(Cloud(cloud));
    cloud.positions.push_back(Vec3f(1e6f, 3e5f, 2e5f));
    SurfaceReport report;
    const Splats splats = estimateSplats(std::move(cloud), {}, report);
    EXPECT_EQ(report.outliers_removed, 1u);
    EXPECT_EQ(splats.positions, alone.positions);
    EXPECT_EQ(splats.normals, alone.normals);
    EXPECT_EQ(splats.radii, alone.radii);
}

TEST(Outliers, NearlyCoincidentPairsStay) {
    Shape shape = gridPlane(40);
    const Shape twin = shape;
    for (const Vec3f& p : twin.positions) shape.add(p.cast<double>() + Vec3d(1e-6, 0, 0), Vec3d::UnitZ());
    SurfaceReport report;
    estimateSplats(shape.cloud(), {}, report);
    EXPECT_EQ(report.outliers_removed, 0u);
}

} // namespace
} // namespace pointrt::test

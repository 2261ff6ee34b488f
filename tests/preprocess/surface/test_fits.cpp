// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include "preprocess/surface/neighborhood.h"
#include "preprocess/surface/quadric.h"
#include "tests/preprocess/surface/shapes.h"

namespace pointrt::test {
namespace {

using namespace surface;

/// A neighbourhood with a support radius of 1, padded to full lanes.
Neighborhood neighborhood(const Shape& shape) {
    Neighborhood around;
    around.count = shape.positions.size();
    const std::size_t room = around.laneGroups() * kLaneCount;
    for (auto* values : {&around.x, &around.y, &around.z, &around.nx, &around.ny, &around.nz, &around.weight})
        values->resize(room, 0);
    for (std::size_t i = 0; i < around.count; ++i) {
        const Vec3f &p = shape.positions[i], &n = shape.normals[i];
        around.x[i] = p.x(), around.y[i] = p.y(), around.z[i] = p.z();
        around.nx[i] = n.x(), around.ny[i] = n.y(), around.nz[i] = n.z();
        around.weight[i] = 1;
    }
    return around;
}

/// 25 points on [-0.5, 0.5]^2.
template <typename Height>
Shape patch(const Height& height) {
    Shape shape;
    for (int i = -2; i <= 2; ++i)
        for (int j = -2; j <= 2; ++j) shape.add(Vec3d(i / 4.0, j / 4.0, height(i / 4.0, j / 4.0)), Vec3d::UnitZ());
    return shape;
}

/// The x coordinates of the neighbours gathered around a point that has too many of them.
std::vector<float> placesAround(const PointSet& points, std::size_t point) {
    std::vector<float> radii(points.size(), 0), places;
    radii[point] = 0.4f;
    const NearestSearch search(points.positions);
    NeighborhoodGatherer gatherer(points, points.positions, search, radii);
    for (std::size_t block = 0; block < NeighborhoodGatherer::blockCount(points.size()); ++block)
        gatherer.forBlock(block, [&](std::size_t, const Neighborhood& around) {
            for (const std::uint32_t i : around.indices) places.push_back(points.positions[i].x());
            places.resize(around.count);
        });
    std::sort(places.begin(), places.end());
    return places;
}

TEST(NeighborhoodGatherer, SelectsTheSameNeighborsInAnyCloud) {
    Random random(3);
    PointSet points;
    for (int i = 0; i < 2000; ++i) {
        points.positions.emplace_back(float(uniform(random)), float(uniform(random)), 0.01f * float(uniform(random)));
        points.normals.push_back(Vec3f::UnitZ());
    }
    points.positions[0] = Vec3f(0.5f, 0.5f, 0);
    const std::vector<float> alone = placesAround(points, 0);
    EXPECT_LE(alone.size(), 192u);
    EXPECT_GT(alone.size(), 96u);
    std::reverse(points.positions.begin(), points.positions.end()); // with other points added
    for (int i = 0; i < 3000; ++i) {
        points.positions.emplace_back(float(uniform(random)) - 1.5f, float(uniform(random)), 0);
        points.normals.push_back(Vec3f::UnitZ());
    }
    EXPECT_EQ(placesAround(points, 1999), alone);
}

TEST(Sphere, OfPointsOnASphere) {
    const Vec3d center(0.1, -0.2, -2);
    Shape shape;
    for (const Vec3f& p : patch([](double, double) { return 0; }).positions) {
        const Vec3d out = (p.cast<double>() - center).normalized();
        shape.add(center + 2.5 * out, out);
    }
    const AlgebraicSphere sphere = fitSphere(neighborhood(shape), AlgebraicSphere::plane(Vec3f::UnitZ()), 10);
    const Vec3d nearest = center + 2.5 * (-center).normalized();
    EXPECT_LT((projectOrigin(sphere).cast<double>() - nearest).norm(), 1e-4);
    EXPECT_LT(degreesBetween(normalAtOrigin(sphere), (-center).cast<float>()), 0.01);
    EXPECT_NEAR(supportOf(neighborhood(shape), sphere, 0.1f), 1, 1e-3);
}

TEST(Sphere, OfAPlaneIsFlat) {
    const Shape shape = patch([](double, double) { return 0.25; });
    const AlgebraicSphere sphere = fitSphere(neighborhood(shape), AlgebraicSphere::plane(Vec3f::UnitZ()), 10);
    EXPECT_LT((projectOrigin(sphere) - Vec3f(0, 0, 0.25f)).norm(), 1e-5f);
}

TEST(Sphere, OutliersHardlyCount) {
    Shape shape = patch([](double, double) { return 0; });
    for (int i = 0; i < 8; ++i) shape.add(Vec3d(i / 16.0, 0, 1), Vec3d::UnitZ()); // another layer, a third as many
    const AlgebraicSphere sphere = fitSphere(neighborhood(shape), AlgebraicSphere::plane(Vec3f::UnitZ()), 0.1f);
    EXPECT_LT(projectOrigin(sphere).norm(), 0.01f);
    EXPECT_NEAR(supportOf(neighborhood(shape), sphere, 0.1f), 25.0 / 33, 0.01);
}

TEST(Quadric, FindsItsOwnTerms) {
    const Shape shape = patch([](double x, double y) { return 0.1 + 0.3 * x - 0.2 * y + 0.4 * x * x - 0.1 * x * y; });
    const TangentFrame frame(Vec3f::UnitZ());
    const auto fit = fitQuadric(neighborhood(shape), frame, AlgebraicSphere::plane(Vec3f::UnitZ()), 100);
    ASSERT_TRUE(fit);
    EXPECT_LT(degreesBetween(normalOf(fit->terms, frame), Vec3f(-0.3f, 0.2f, 1)), 0.01);
    EXPECT_NEAR(fit->terms[0], 0.1, 1e-4);
    EXPECT_NEAR(fit->variance, 0, 1e-6);
}

TEST(Quadric, NeedsMoreThanALine) {
    Shape shape;
    for (int i = 0; i < 20; ++i) shape.add(Vec3d(i / 20.0, 0, 0), Vec3d::UnitZ());
    const TangentFrame frame(Vec3f::UnitZ());
    EXPECT_FALSE(fitQuadric(neighborhood(shape), frame, AlgebraicSphere::plane(Vec3f::UnitZ()), 100));
}

} // namespace
} // namespace pointrt::test

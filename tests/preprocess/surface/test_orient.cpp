// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include "preprocess/surface/orient_tree.h"
#include "tests/preprocess/surface/shapes.h"

namespace pointrt::test {
namespace {

std::size_t wrongSides(const Splats& splats, const Shape& shape) {
    std::size_t wrong = 0;
    for (const double error : normalErrors(splats, shape)) wrong += error > 90;
    return wrong;
}

/// The lower half of a sphere, whose outside faces down; too steep near the border to face up or down.
Shape bowl() {
    Shape shape;
    const Shape sphere = randomSphere(20'000);
    for (std::size_t i = 0; i < sphere.positions.size(); ++i)
        if (sphere.positions[i].z() < -0.1f)
            shape.add(sphere.positions[i].cast<double>(), sphere.normals[i].cast<double>());
    return shape;
}

TEST(Orient, SphereAndTorusOutwards) {
    for (const Shape& shape : {randomSphere(10'000), fibonacciSphere(10'000), randomTorus(20'000)}) {
        const Splats splats = estimate(shape.cloud());
        EXPECT_TRUE(splats.oriented);
        EXPECT_EQ(wrongSides(splats, shape), 0u);
    }
}

TEST(Orient, LargeCloudsOutwards) {
    const Shape shape = randomTorus(150'000);
    EXPECT_EQ(wrongSides(estimate(shape.cloud()), shape), 0u);
}

TEST(Orient, DisconnectedSpheresEachOutwards) {
    Shape shape = randomSphere(5000);
    shape.append(randomSphere(3000, Vec3d(5, 0, 0), 1, 7));
    shape.append(randomSphere(2000, Vec3d(0, 0, -9), 2, 8));
    EXPECT_EQ(wrongSides(estimate(shape.cloud()), shape), 0u);
}

TEST(Orient, ThinPlateOfTwoSheets) {
    Shape shape = gridPlane(60, 0, -Vec3d::UnitZ());
    shape.append(gridPlane(60, 0.1, Vec3d::UnitZ())); // six spacings apart, open at the border
    Cloud cloud = shape.cloud();
    cloud.sensors = {Vec3f(0.5f, 0.5f, 5), Vec3f(0.5f, 0.5f, -5)};
    for (const Vec3f& p : cloud.positions) cloud.sensor_of_point.push_back(p.z() > 0.05f ? 0 : 1);
    EXPECT_EQ(wrongSides(estimate(std::move(cloud)), shape), 0u);
}

/// Points of one sheet are in neighbour lists of the other: edges join similar normals on opposite sides.
TEST(Orient, PlateThreeSpacingsThick) {
    for (const int steps : {100, 250}) // below and above the limit of CGAL's algorithm
        for (const double noise : {0.0, 0.2}) {
            Shape shape = thinPlate(steps, 3);
            addNoise(shape, noise / steps);
            EXPECT_LE(wrongSides(estimate(shape.cloud()), shape), 2u) << steps << " steps, noise " << noise;
        }
}

TEST(Orient, BowlOutwardsThoughItsHighestPointFacesDown) {
    const Shape shape = bowl();
    EXPECT_EQ(wrongSides(estimate(shape.cloud()), shape), 0u);
}

TEST(Orient, TerrainUpwards) {
    Shape shape;
    for (int i = 0; i < 80; ++i)
        for (int j = 0; j < 80; ++j) {
            const double z = std::sin(0.2 * i) * std::cos(0.15 * j);
            shape.add(Vec3d(0.5 * i, 0.5 * j, z), Vec3d::UnitZ());
        }
    EXPECT_EQ(wrongSides(estimate(shape.cloud()), shape), 0u);
}

TEST(Orient, TowardsTheSensor) {
    const Shape shape = randomSphere(5000);
    Cloud cloud = shape.cloud();
    cloud.sensors = {Vec3f(0, 0, 0)}; // inside: all normals point inwards
    cloud.sensor_of_point.assign(5000, 0);
    for (const OrientMode mode : {OrientMode::kAuto, OrientMode::kSensor}) {
        SurfaceOptions options;
        options.orient = mode;
        EXPECT_EQ(wrongSides(estimate(cloud, options), shape), 5000u);
    }
    SurfaceOptions options;
    options.orient = OrientMode::kMst;
    EXPECT_EQ(wrongSides(estimate(cloud, options), shape), 0u) << "kMst ignores the sensor";
}

TEST(Orient, UpwardsWithUp) {
    const Shape shape = bowl();
    SurfaceOptions options;
    options.orient = OrientMode::kUp;
    Cloud cloud = shape.cloud();
    EXPECT_EQ(wrongSides(estimate(cloud, options), shape), cloud.positions.size()) << "+Z is the default up";
    cloud.world.up = -Vec3d::UnitZ();
    EXPECT_EQ(wrongSides(estimate(cloud, options), shape), 0u);
}

TEST(Orient, AirborneScansFaceUp) {
    const Shape shape = bowl();
    Cloud cloud = shape.cloud();
    cloud.world.up = Vec3d::UnitZ();
    EXPECT_EQ(wrongSides(estimate(cloud), shape), 0u) << "not airborne";
    cloud.world.from_above = true;
    EXPECT_EQ(wrongSides(estimate(cloud), shape), cloud.positions.size());
    cloud.sensors = {Vec3f(0, 0, -100)};
    cloud.sensor_of_point.assign(cloud.positions.size(), 0);
    EXPECT_EQ(wrongSides(estimate(cloud), shape), 0u) << "a sensor takes precedence";
}

TEST(Orient, PointsWithoutSensorFollowThoseWithOne) {
    const Shape shape = randomSphere(5000);
    Cloud cloud = shape.cloud();
    cloud.sensors = {Vec3f(0, 0, 0)};
    for (const Vec3f& p : cloud.positions) cloud.sensor_of_point.push_back(p.z() > 0.9f ? 0 : kNoSensor);
    EXPECT_EQ(wrongSides(estimate(std::move(cloud)), shape), 5000u);
}

TEST(Orient, PointsWithoutNormalFollowGivenOnes) {
    const Shape shape = randomSphere(5000);
    Cloud cloud = shape.cloud();
    for (std::size_t i = 0; i < 5000; ++i)
        cloud.normals.push_back(shape.positions[i].z() > 0.9f ? Vec3f(-shape.normals[i]) : Vec3f(0, 0, 0));
    EXPECT_EQ(wrongSides(estimate(std::move(cloud)), shape), 5000u);
}

TEST(Orient, GivenAxesAreTurnedOutwards) {
    const Shape shape = randomTorus(20'000);
    Cloud cloud = shape.cloud();
    cloud.normals = shape.normals;
    for (std::size_t i = 0; i < cloud.normals.size(); i += 3) cloud.normals[i] = -cloud.normals[i];
    cloud.normal_sides = false;
    const Splats splats = estimate(std::move(cloud));
    EXPECT_EQ(wrongSides(splats, shape), 0u);
    for (const double error : normalErrors(splats, shape)) ASSERT_LT(error, 0.01); // only the side changes
}

TEST(Orient, GivenNormalsKeepTheirSideAgainstTheSensor) {
    const Shape shape = randomSphere(2000);
    Cloud cloud = shape.cloud();
    cloud.normals = shape.normals;
    cloud.sensors = {Vec3f(0, 0, 0)};
    cloud.sensor_of_point.assign(2000, 0);
    EXPECT_EQ(wrongSides(estimate(cloud), shape), 0u);
}

TEST(Orient, NoneLeavesNormalsAndReportsIt) {
    const Shape shape = randomSphere(2000);
    SurfaceOptions options;
    options.orient = OrientMode::kNone;
    SurfaceReport report;
    EXPECT_FALSE(estimateSplats(shape.cloud(), options, report).oriented);
    EXPECT_EQ(report.normals_flipped, 0u);
    Cloud cloud = shape.cloud();
    cloud.normals = shape.normals;
    EXPECT_TRUE(estimate(std::move(cloud), options).oriented);
}

TEST(Orient, BothTreesAgree) {
    using namespace surface;
    const Shape shape = randomTorus(20'000);
    const StageProgress silent;
    PointSet by_cgal = takePoints(shape.cloud());
    const NearestSearch search(by_cgal.positions);
    const NeighborLists lists = findNeighbors(by_cgal, search, 16, {silent, "test"});
    Random random(6);
    for (const std::uint32_t index : by_cgal.input_index)
        by_cgal.normals.push_back(uniform(random) < 0.5 ? shape.normals[index] : Vec3f(-shape.normals[index]));
    std::vector<std::uint8_t> sources(by_cgal.size(), 0);
    sources[0] = 1;
    PointSet by_kruskal = by_cgal;
    orientByCgal(by_cgal, lists, sources);
    orientByKruskal(by_kruskal, lists, edgeKinds(by_kruskal, lists), sources);
    EXPECT_EQ(by_cgal.normals, by_kruskal.normals);
}

} // namespace
} // namespace pointrt::test

// SPDX-License-Identifier: Apache-2.0
// Discs shrink where a scanner saw through them, and nowhere else.
#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include "preprocess/surface/sightlines.h"
#include "tests/preprocess/surface/shapes.h"

namespace pointrt::test {
namespace {

using namespace surface;

/// Discs and sensors.
struct SightlinesScene {
    PointSet points;

    void add(const Vec3d& position, const Vec3d& normal, double radius, std::uint32_t sensor = 0) {
        points.positions.push_back(position.cast<float>());
        points.normals.push_back(normal.normalized().cast<float>());
        points.sensor_of_point.push_back(sensor);
        points.input_index.push_back(std::uint32_t(points.input_index.size()));
        points.radii.push_back(float(radius));
    }
};

/// The radii after clearSightlines. shrunk: the number that it returns.
std::vector<float> cleared(const SightlinesScene& scene, std::size_t* shrunk = nullptr, std::size_t not_measured = 0) {
    const StageProgress silent;
    PointGraph graph;
    graph.points = scene.points;
    graph.connect(16, {silent, "neighbors"});
    const std::size_t count = clearSightlines(graph, graph.points.size() - not_measured, {silent, "radii"});
    if (shrunk) *shrunk = count;
    return graph.points.radii;
}

constexpr int kHigh = 21, kPosts = 2 * kHigh;
constexpr double kSightlinesStep = 0.1;

/// Sensor 0, at the origin, sees two posts at y = 2, 1 m apart, and between them a wall at y = 6. Points on the posts
/// are a step apart, and have discs of 0.6 m. Sightlines to the wall cross the plane of the posts a step apart, from x
/// = -0.3 to 0.3.
SightlinesScene gap(std::uint32_t wall_sensor = 0) {
    SightlinesScene scene;
    scene.points.sensors = {Vec3f(0, 0, 0), Vec3f(0, 0, 0)};
    for (const double x : {-0.5, 0.5})
        for (int i = 0; i < kHigh; ++i) scene.add({x, 2, kSightlinesStep * (i - kHigh / 2)}, -Vec3d::UnitY(), 0.6);
    for (int i = -3; i <= 3; ++i)
        for (int j = 0; j < kHigh; ++j)
            scene.add(Vec3d(kSightlinesStep * i, 2, kSightlinesStep * (j - kHigh / 2)) * 3, -Vec3d::UnitY(), 0.25,
                      wall_sensor);
    return scene;
}

TEST(Sightlines, DiscsShrinkToTheGapThatTheirSensorSawThrough) {
    const SightlinesScene scene = gap();
    std::size_t shrunk = 0;
    const std::vector<float> radii = cleared(scene, &shrunk);
    EXPECT_EQ(shrunk, std::size_t{kPosts});
    for (std::size_t i = 0; i < radii.size(); ++i)
        if (i < kPosts)
            EXPECT_NEAR(radii[i], 0.2f, 1e-5f) << "the nearest sightline is at x = 0.3";
        else
            EXPECT_EQ(radii[i], scene.points.radii[i]) << "nothing is behind the wall";
}

TEST(Sightlines, NothingShrinksWithoutASensor) {
    SightlinesScene scene = gap();
    scene.points.sensors.clear();
    EXPECT_EQ(cleared(scene), scene.points.radii);
    scene = gap();
    std::fill(scene.points.sensor_of_point.begin(), scene.points.sensor_of_point.end(), kNoSensor);
    EXPECT_EQ(cleared(scene), scene.points.radii);
}

TEST(Sightlines, InsertedPointsHaveNoSightlines) {
    const SightlinesScene scene = gap();
    EXPECT_EQ(cleared(scene, nullptr, scene.points.size() - kPosts), scene.points.radii);
}

TEST(Sightlines, ScatteredPointsKeepTheirDiscs) {
    SightlinesScene scene = gap();
    scene.points.planarity.assign(scene.points.radii.size(), 1.0f);
    scene.points.planarity[0] = 0.0f;
    const std::vector<float> radii = cleared(scene);
    EXPECT_EQ(radii[0], scene.points.radii[0]);
    EXPECT_NEAR(radii[1], 0.2f, 1e-5f);
}

/// For sensors of other scans, the third sightline counts: one is 0.2 m from a post's point; at the ends of a post, one
/// more is at the square root of 0.05, elsewhere two are.
TEST(Sightlines, OtherSensorsNeedThree) {
    const SightlinesScene scene = gap(1);
    const std::vector<float> radii = cleared(scene);
    for (std::size_t i = 0; i < kPosts; ++i) {
        const bool end = i % kHigh == 0 || i % kHigh == kHigh - 1;
        EXPECT_NEAR(radii[i], end ? std::sqrt(0.08f) : std::sqrt(0.05f), 1e-5f) << i;
    }
}

TEST(Sightlines, DiscsKeepHalfTheDistanceToTheSecondNeighbor) {
    SightlinesScene scene = gap();
    for (std::size_t i = 0; i < kPosts; ++i) scene.points.positions[i].x() *= 0.52f; // 0.26; sightlines at 0.2
    for (std::size_t i = 0; i < 3; ++i) { // other points of the first post: half a metre apart
        scene.points.positions[i].z() = float(i) * 0.5f + 3;
        scene.points.positions[i].x() = -0.2f;
        scene.points.radii[i] = 0.7f;
    }
    for (int i = 0; i < 40; ++i) scene.add(Vec3d(-0.2, 2, 3 + 0.025 * i) * 3, -Vec3d::UnitY(), 0.05);
    EXPECT_NEAR(cleared(scene)[1], 0.25f, 1e-6f) << "sightlines pass through its centre";
}

/// Sightlines at 2 degrees to the floor; errors of up to 10 degrees in normals, of 0.002 in heights.
TEST(Sightlines, AFloorAtAGrazingAngleStaysClosed) {
    SightlinesScene scene;
    scene.points.sensors = {Vec3f(0, 0, 1)};
    Random random(5);
    for (int i = 0; i < 100; ++i)
        for (int j = -50; j < 50; ++j) {
            const double tilt = 0.17 * uniform(random), around = 6.28 * uniform(random);
            const Vec3d normal(std::sin(tilt) * std::cos(around), std::sin(tilt) * std::sin(around), std::cos(tilt));
            scene.add({24 + 0.1 * i, 0.1 * j, 0.002 * gaussian(random)}, normal, 0.15);
        }
    scene.points.noise.assign(scene.points.radii.size(), 0.002f);
    std::size_t shrunk = 1;
    EXPECT_EQ(cleared(scene, &shrunk), scene.points.radii);
    EXPECT_EQ(shrunk, 0u);
}

/// A wall with a noise of one spacing, seen head-on: points behind a disc belong to the wall.
TEST(Sightlines, NoisyPointsAreNotBehindTheirDiscs) {
    SightlinesScene scene;
    scene.points.sensors = {Vec3f(0, 0, 0)};
    Random random(6);
    for (int i = -30; i < 30; ++i)
        for (int j = -30; j < 30; ++j)
            scene.add(Vec3d(0.1 * i, 5, 0.1 * j) * (1 + 0.02 * std::clamp(gaussian(random), -2.4, 2.4)),
                      -Vec3d::UnitY(), 0.3);
    scene.points.noise.assign(scene.points.radii.size(), 0.1f);
    EXPECT_EQ(cleared(scene), scene.points.radii);
    scene.points.noise.clear();
    EXPECT_NE(cleared(scene), scene.points.radii) << "without the noise";
}

TEST(Sightlines, SensorsThatRepresentADirectionDoNotCount) {
    SightlinesScene scene = gap();
    scene.points.sensors[0] = Vec3f(0, -60, 0);
    for (std::size_t i = 0; i < kPosts; ++i) scene.points.radii[i] = 1.2f;
    EXPECT_EQ(cleared(scene), scene.points.radii);
}

/// One sensor cannot see all sides of a sphere.
TEST(Sightlines, InconsistentSensorsDoNotCount) {
    const Shape sphere = randomSphere(20'000);
    SightlinesScene scene;
    scene.points.sensors = {Vec3f(0, 0, 3)};
    for (std::size_t i = 0; i < sphere.positions.size(); ++i)
        scene.add(sphere.positions[i].cast<double>(), sphere.normals[i].cast<double>(), 0.05);
    EXPECT_EQ(cleared(scene), scene.points.radii);
    SightlinesScene front;
    front.points.sensors = scene.points.sensors;
    for (std::size_t i = 0; i < sphere.positions.size(); ++i)
        if (sphere.positions[i].z() > 1.0f / 3) // the visible part
            front.add(sphere.positions[i].cast<double>(), sphere.normals[i].cast<double>(), 0.05);
    EXPECT_EQ(cleared(front), front.points.radii) << "nothing is behind it";
}

TEST(Sightlines, DoNotDependOnThreads) {
    Random random(8);
    SightlinesScene scene;
    for (int i = 0; i < 3; ++i)
        scene.points.sensors.push_back(Vec3f(float(uniform(random)), float(uniform(random)), float(i)));
    for (int i = 0; i < 30'000; ++i) {
        const Vec3d at(8 * uniform(random) - 4, 3 + 3 * std::floor(2 * uniform(random)), 8 * uniform(random) - 4);
        if (at.y() < 4 && at.norm() < 4.5) continue; // a hole in the nearer wall
        scene.add(at, -Vec3d::UnitY(), 0.5, std::uint32_t(3 * uniform(random)));
    }
    const auto with = [&](std::size_t threads, std::size_t& shrunk) {
        const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, threads);
        return cleared(scene, &shrunk);
    };
    std::size_t one = 0, three = 0;
    EXPECT_EQ(with(1, one), with(3, three));
    EXPECT_EQ(one, three);
    EXPECT_GT(one, 100u);
}

/// A wall with a doorway in front of another wall: the doorway stays open from where it was scanned.
TEST(Sightlines, ADoorwayIsOpenInTheSplats) {
    Cloud cloud;
    cloud.sensors = {Vec3f(0, 0, 0)};
    for (int i = -60; i <= 60; ++i)
        for (int j = -40; j <= 40; ++j) {
            Vec3f direction(float(i) * 0.01f, 1, float(j) * 0.01f); // at 3 m a step is 3 cm
            const bool doorway = std::abs(i) <= 4 && j <= 20;
            cloud.positions.push_back(direction * (doorway ? 6.0f : 3.0f));
            cloud.sensor_of_point.push_back(0);
        }
    SurfaceReport report;
    const Splats splats = estimateSplats(Cloud(cloud), {}, report);
    for (std::size_t i = 0; i < splats.positions.size(); ++i) {
        if (splats.positions[i].y() > 4) continue;
        for (const Vec3f& seen : cloud.positions) {
            if (seen.y() < 4) continue;
            const float share = splats.normals[i].dot(splats.positions[i]) / splats.normals[i].dot(seen);
            if (share < 0 || share > 0.95f) continue;
            EXPECT_GE((share * seen - splats.positions[i]).norm(), 0.99f * splats.radii[i])
                << splats.positions[i].transpose() << " hides " << seen.transpose();
        }
    }
}

} // namespace
} // namespace pointrt::test

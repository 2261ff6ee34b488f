// SPDX-License-Identifier: Apache-2.0
// Simulated devices in front of surfaces with known scans.
#include <gtest/gtest.h>

#include <filesystem>

#include "preprocess/input/read.h"
#include "tests/bench/quality/devices/beam.h"
#include "tests/bench/quality/devices/judge.h"
#include "tests/support/temporary_folder.h"

namespace pointrt::quality {

namespace {

/// A vertical rectangle perpendicular to x, from (x, y0) to (x, y1) and from z0 to z1, facing -x.
void addScreen(World& world, double x, double y0, double y1, double z0, double z1) {
    WorldBuilder(world).addQuad({x, y1, z0}, {x, y0, z0}, {x, y0, z1}, {x, y1, z1}, Part::kWall);
}

/// A horizontal plate at height z, facing up.
void addPlate(World& world, double half, double z) {
    WorldBuilder(world).addQuad({-half, -half, z}, {half, -half, z}, {half, half, z}, {-half, half, z}, Part::kWall);
}

double meanOf(const std::vector<double>& values) {
    double sum = 0;
    for (const double value : values) sum += value;
    return sum / static_cast<double>(values.size());
}

double deviationOf(const std::vector<double>& values) {
    const double mean = meanOf(values);
    double sum = 0;
    for (const double value : values) sum += (value - mean) * (value - mean);
    return std::sqrt(sum / static_cast<double>(values.size()));
}

TEST(RandomTest, NormalNumbersHaveDeviationOneAndStreamsDiffer) {
    std::vector<double> values;
    for (std::uint64_t stream = 0; stream < 20000; ++stream) values.push_back(Random(5, stream).normal());
    EXPECT_NEAR(meanOf(values), 0, 0.03);
    EXPECT_NEAR(deviationOf(values), 1, 0.03);
}

TEST(WorldTest, FacesOfABoxLookOutwards) {
    World world;
    WorldBuilder(world).addBox({1, 2, 3}, {2, 4, 6}, Part::kOther, 30);
    double six_volumes = 0;
    for (std::uint32_t i = 0; i < world.mesh.triangles.size(); ++i) {
        six_volumes += (world.mesh.corner(i, 0) - Vec3d(1, 2, 3)).dot(world.mesh.faceNormal(i));
    }
    EXPECT_NEAR(six_volumes / 6, 48, 1e-4);
}

TEST(WorldTest, FacadeIsWholeAndItsPanesLieDeeper) {
    World world;
    WorldBuilder(world).addFacade({0, 0, 0}, {10, 0, 0}, 6, {2, 2, 1.0, 1.4, 0.9, 3.0, 0.15});
    const WorldTracing tracing(world);
    std::size_t deep = 0, all = 0;
    for (double x = 0.05; x < 10; x += 0.1)
        for (double z = 0.05; z < 6; z += 0.1, ++all) {
            const auto hit = tracing.firstHit({x, -5, z}, Vec3d::UnitY()); // from the right as seen along x
            ASSERT_TRUE(hit) << x << " " << z;
            deep += hit->range > 5.1;
        }
    EXPECT_NEAR(static_cast<double>(deep) / static_cast<double>(all), 4 * 1.4 / 60, 0.01); // four windows of 1 x 1.4
}

TEST(WorldTest, ScenesOfTheTwoVariantsDiffer) {
    for (const auto& scene : {roomWorld, houseWorld, streetWorld})
        EXPECT_NE(scene(1).mesh.positions, scene(2).mesh.positions);
    EXPECT_EQ(houseWorld(1).crowns.size(), 3u);
}

TEST(BeamTest, EdgeSplitsTheBeamInTwo) {
    World world;
    addScreen(world, 10, -5, 0, -5, 5); // the half to the right
    addScreen(world, 12, -5, 5, -5, 5);
    const WorldTracing tracing(world);
    const Beam beam{0, 0.001, 4};
    const auto echoes = echoesOf(tracing, beam, {0, 1e-5, 0}, Vec3d::UnitX(), 100);
    const auto apart = grouped(echoes, 0.5);
    ASSERT_EQ(apart.size(), 2u);
    EXPECT_NEAR(apart[0].range, 10, 1e-3);
    EXPECT_NEAR(apart[1].range, 12, 1e-3);
    EXPECT_NEAR(apart[0].power, 0.5, 0.1);
    EXPECT_NEAR(totalPower(echoes), 1, 1e-3);
    const auto mixed = grouped(echoes, 100);
    ASSERT_EQ(mixed.size(), 1u); // a phase scanner reports a range in between
    EXPECT_NEAR(mixed[0].range, 11, 0.2);
}

TEST(TriangulationTest, PlateIsFlatAndCurlsAtItsEdges) {
    World world;
    addPlate(world, 0.02, 0); // facing the scanner, whose first view is along -z of the world
    const WorldTracing tracing(world);
    Triangulation device;
    device.noise = device.pose_offset = device.pose_turn_deg = 0;
    const GridScan scan = scanByTriangulation(tracing, device, 0.03, 1).front();
    double inside = 0, at_edge = 0, farthest = 0;
    for (const Vec3d& sample : scan.samples) {
        if (!isTaken(sample)) continue;
        double& most = std::abs(sample.x()) < 0.019 ? inside : at_edge;
        most = std::max(most, std::abs(sample.z()));
        farthest = std::max(farthest, std::abs(sample.x()));
    }
    EXPECT_LT(inside, 1e-6);
    // the centre of half a Gaussian sheet is at 0.8 standard deviations, each half the half width: 0.2 mm aside, times
    // cot(30 degrees) in range
    EXPECT_GT(at_edge, 0.00025);
    EXPECT_LT(at_edge, 0.001);
    EXPECT_LT(farthest, 0.02 + device.half_width);
}

TEST(TriangulationTest, ConfPlacesScansOnTheObject) {
    World world;
    WorldBuilder(world).addBall({0.003, 0.002, 0.001}, 0.02);
    const WorldTracing tracing(world);
    const test::TemporaryFolder folder;
    writeConf(folder.path.string(), scanByTriangulation(tracing, {}, 0.025, 1));
    const Cloud cloud = readInputs({folder.file("scan.conf")}, {});
    ASSERT_GT(cloud.positions.size(), 10000u);
    EXPECT_EQ(cloud.scans.size(), 8u);
    std::vector<double> off;
    for (const Vec3f& position : cloud.positions)
        off.push_back(std::abs((cloud.origin + position.cast<double>() - Vec3d(0.003, 0.002, 0.001)).norm() - 0.02));
    EXPECT_LT(meanOf(off), 0.0004); // the pose, the curl
    EXPECT_GT(meanOf(off), 0.00005);
}

TEST(DepthCameraTest, StepsGrowWithTheSquareOfDepth) {
    const DepthCamera device;
    // Khoshelham and Oude Elberink, figure 10: about 2 mm at 1 m (2.85 mm by the formula), 7 cm at 5 m
    const auto step = [&](double depth) {
        const double low = quantizedDepth(device, depth, 0);
        return quantizedDepth(device, low, -1) - low;
    };
    EXPECT_NEAR(step(1), 0.00285, 0.0001);
    EXPECT_NEAR(step(5), 0.0713, 0.003);
}

TEST(DepthCameraTest, WallIsSeenInStepsAndThroughAFile) {
    World world;
    WorldBuilder(world).addQuad({-5, 5, 3}, {5, 5, 3}, {5, -5, 3}, {-5, -5, 3}, Part::kWall);
    const GridScan scan = scanByDepthCamera(WorldTracing(world), {}, 1);
    std::vector<double> depths;
    for (const Vec3d& sample : scan.samples)
        if (isTaken(sample)) depths.push_back(sample.z());
    EXPECT_EQ(depths.size(), 640u * 480u);
    EXPECT_NEAR(meanOf(depths), 3, 0.005);
    EXPECT_NEAR(deviationOf(depths), 0.0257 * std::sqrt(0.25 + 1.0 / 12), 0.003); // half a step, and rounding
    const test::TemporaryFolder folder;
    writeOrganizedPcd(folder.file("scan.pcd"), scan);
    EXPECT_EQ(readInputs({folder.file("scan.pcd")}, {}).positions.size(), depths.size());
}

TEST(TerrestrialTest, MixedPixelsLieBetweenTwoScreens) {
    World world;
    // no edge along a row or column of the grid, which would hit all of it or none
    WorldBuilder(world).addQuad({10, 3, -3}, {10, -3, -2.5}, {10, -2.5, 3}, {10, 3.5, 2.6}, Part::kWall);
    addScreen(world, 12, -9, 9, -9, 9);
    const GridScan scan = scanByTerrestrial(WorldTracing(world), {}, {0, 0, 0}, 1);
    std::size_t near = 0, far = 0, between = 0;
    std::vector<double> off;
    for (const Vec3d& sample : scan.samples) {
        if (!isTaken(sample)) continue;
        near += sample.x() < 10.05;
        far += sample.x() > 11.95;
        between += sample.x() >= 10.05 && sample.x() <= 11.95;
        if (sample.x() < 10.05) off.push_back(sample.x() - 10);
    }
    EXPECT_GT(between, 20u);
    EXPECT_LT(between, near / 20);
    EXPECT_GT(far, near / 2);
    EXPECT_NEAR(deviationOf(off), 0.0005, 0.0001);
}

TEST(TerrestrialTest, PtxHasTheStationsPose) {
    World world;
    addScreen(world, 15, -3, 3, 0, 3);
    TerrestrialScanner device;
    device.pose_offset = 0;
    const GridScan scan = scanByTerrestrial(WorldTracing(world), device, {5, 1, 1.7}, 1);
    const test::TemporaryFolder folder;
    writePtx(folder.file("scan.ptx"), {scan});
    const Cloud cloud = readInputs({folder.file("scan.ptx")}, {});
    ASSERT_FALSE(cloud.positions.empty());
    for (const Vec3f& position : cloud.positions) ASSERT_NEAR(cloud.origin.x() + position.x(), 15, 0.01);
    ASSERT_EQ(cloud.scans.size(), 1u);
    ASSERT_TRUE(cloud.scans[0].sensor);
    EXPECT_NEAR((*cloud.scans[0].sensor - Vec3d(5, 1, 1.7)).norm(), 0, 1e-5);
}

TEST(AirborneTest, EavesGiveTwoReturns) {
    World world;
    addPlate(world, 30, 0);
    WorldBuilder(world).addQuad({-8, -8, 6}, {8, -8, 6}, {8, 8, 6}, {-8, 8, 6}, Part::kWall);
    AirborneScanner device;
    device.pose_offset = 0;
    const auto returns = scanByAirborne(WorldTracing(world), device, 10, 1);
    std::size_t several = 0, last = 0;
    for (const Return& back : returns) {
        EXPECT_TRUE(std::abs(back.position.z()) < 0.12 || std::abs(back.position.z() - 6) < 0.12) << back.position;
        several += back.of == 2;
        last += back.number == 2;
    }
    EXPECT_GT(several, 50u);
    EXPECT_EQ(several, 2 * last);
    const double pulses = static_cast<double>(returns.size() - last); // 2 strips of 8 per square metre
    EXPECT_NEAR(pulses, 2 * 400 / (0.35 * 0.35), 100);
    const test::TemporaryFolder folder;
    writeLas(folder.file("scan.las"), returns);
    EXPECT_EQ(readInputs({folder.file("scan.las")}, {}).positions.size(), returns.size());
}

TEST(SpinningTest, RingsLieOnTheGround) {
    World world;
    addPlate(world, 60, 0);
    SpinningLidar device;
    device.pose_offset = device.pose_turn_deg = 0;
    const auto points = scanBySpinning(WorldTracing(world), device, {{0, 0, 2}}, 1);
    std::vector<double> heights;
    std::size_t first_ring = 0;
    for (const Vec3d& point : points) {
        heights.push_back(point.z());
        first_ring += point.head<2>().norm() < 3.45; // 2 m / tan(30.67 degrees) is 3.37 m, the next ring is at 3.57
    }
    EXPECT_NEAR(meanOf(heights), 0, 0.02);
    EXPECT_NEAR(static_cast<double>(first_ring), 1090, 20);
}

TEST(PhotogrammetryTest, PointsAreNoisyAndSomeAreStrays) {
    World world;
    WorldBuilder(world).addBall({0, 0, 0}, 0.08);
    const auto points = scanByPhotogrammetry(WorldTracing(world), {}, 1);
    std::size_t strays = 0;
    std::vector<double> off;
    for (const Vec3d& point : points) {
        const double distance = point.norm() - 0.08;
        if (std::abs(distance) > 0.002)
            ++strays;
        else
            off.push_back(distance);
    }
    EXPECT_NEAR(static_cast<double>(strays) / static_cast<double>(points.size()), 0.0098, 0.003);
    EXPECT_NEAR(deviationOf(off), 0.0003, 0.00005);
    const double all = 4 * std::numbers::pi * 0.08 * 0.08 / (0.0005 * 0.0005);
    EXPECT_GT(static_cast<double>(points.size()), 0.6 * all); // the underside is hidden
    EXPECT_LT(static_cast<double>(points.size()), 0.99 * all);
}

TEST(GapTest, HalfACrownBehindAScreenIsHalfAGap) {
    World world;
    world.crowns.push_back({{10, 0, 0}, {1, 1, 1}});
    const Pinhole pinhole{{0, 0, 0}, {10, 0, 0}, Vec3d::UnitZ(), 20, 128};
    const UnitCamera camera(pinhole, {});
    Sights truth(pinhole.pixels()), picture(pinhole.pixels());
    for (std::size_t i = 0; i < truth.size(); ++i) {
        if (i % 128 < 64) truth[i] = {10, -Vec3f::UnitX()};         // leaves fill the left half
        picture[i] = {i / 128 < 64 ? 10.f : 20.f, -Vec3f::UnitX()}; // and the upper half, in front of a wall
    }
    truth[64 * 128 + 64] = {5, -Vec3f::UnitX()}; // something in front
    const GapCounts counts = countGaps(world, truth, picture, camera);
    EXPECT_NEAR(static_cast<double>(counts.truth) / static_cast<double>(counts.sights), 0.5, 0.01);
    EXPECT_NEAR(static_cast<double>(counts.picture) / static_cast<double>(counts.sights), 0.5, 0.01);
    const double radius = std::tan(std::asin(0.1)) / std::tan(10 * std::numbers::pi / 180) * 64;
    EXPECT_NEAR(static_cast<double>(counts.sights), std::numbers::pi * radius * radius, 60);
}

} // namespace

} // namespace pointrt::quality

// SPDX-License-Identifier: Apache-2.0
// Simulated scanners in tile sets and scene files.
#include <gtest/gtest.h>

#include <fstream>

#include "pointrt/lidar.hpp"
#include "tests/runtime/rays/set_scenes.h"

namespace pointrt::test {
namespace {

LidarPoints simulate(const TraceScene& scene, const LidarSensor& sensor, const LidarRun& run) {
    LidarPoints all;
    simulateLidar(scene, sensor, run, [&](const LidarPoints& points) { all.append(points); });
    return all;
}

TEST(LidarScenes, ATileSetMeasuresLikeOneFile) {
    const SphereInTiles ball;
    const TraceDevice device;
    const TraceScene whole(device, {ball.whole()}), tiles(device, {ball.tiles()}, {.memory = ball.largestTile()});
    LidarSensor sensor;
    sensor.pattern = LidarSpinning{{-15, -5, 0, 10}, 10, 1, 180, false};
    sensor.max_range_m = 200;
    LidarRun run;
    run.trajectory = {{0, {ball.center.x + 100, ball.center.y, ball.center.z}, {0, 0, 0, 1}}};
    const LidarPoints expected = simulate(whole, sensor, run), points = simulate(tiles, sensor, run);
    ASSERT_GT(points.size(), 100u);
    ASSERT_EQ(points.pulses, expected.pulses);
    EXPECT_TRUE(expected.tile_ids.empty());
    ASSERT_EQ(points.tile_ids.size(), points.size());
    std::vector<std::uint32_t> numbers(points.size());
    tiles.readAttribute("number", points.splat_ids, points.instance_ids, points.tile_ids,
                        std::as_writable_bytes(std::span(numbers)));
    for (std::size_t i = 0; i < points.size(); ++i) {
        ASSERT_NEAR(points.ranges[i], expected.ranges[i], 0.1 * ball.splat_radius) << i;
        const Vec3 position{points.positions[3 * i], points.positions[3 * i + 1], points.positions[3 * i + 2]};
        ASSERT_LT(length(position - ball.points.at(numbers[i])), 1.1 * ball.splat_radius) << i;
    }
}

TEST(LidarScenes, ShapesReflectTheConstantValue) {
    const TemporaryFolder folder;
    std::ofstream(folder.file("shapes.toml"))
        << "[[shape]]\ntype = \"disc\"\ncenter = [0, 0, 0]\nnormal = [0, 0, 1]\nradius = 5\n";
    const TraceDevice device;
    const TraceScene scene(device, {folder.file("shapes.toml")});
    LidarSensor sensor;
    sensor.pattern = LidarTable{{{0, -90, 0, 0}}, 1};
    sensor.max_range_m = 20; // power is 1 at 10 m
    sensor.reflectance = {LidarReflectance::Source::kColor, 0.25, "", 0};
    LidarRun run;
    run.trajectory = {{0, {1, 1, 10}, {0, 0, 0, 1}}};
    const LidarPoints points = simulate(scene, sensor, run);
    ASSERT_EQ(points.size(), 1u);
    EXPECT_NEAR(points.ranges[0], 10, 1e-5);
    EXPECT_NEAR(static_cast<double>(points.powers[0]), 0.25, 1e-5);
    EXPECT_EQ(points.instance_ids[0], kShapesInstance);
    EXPECT_EQ(points.splat_ids[0], kNoHit);
}

} // namespace
} // namespace pointrt::test

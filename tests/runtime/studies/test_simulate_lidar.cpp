// SPDX-License-Identifier: Apache-2.0
// Simulated measurements of planes and discs, checked against formulas.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "pointrt/lidar.hpp"
#include "runtime/studies/reflectance.h"
#include "runtime/util/vec.h"
#include "tests/runtime/rays/ray_scenes.h"
#include "tests/support/says.h"
#include "tests/support/temporary_folder.h"

namespace pointrt::test {
namespace {

constexpr double kRadians = std::numbers::pi / 180;
constexpr std::size_t kSide = 80;
constexpr double kSplatRadius = 128 * 0.8 / kSide; // of planeSplats
/// The plane in the middle of the cube, at the stored precision, and a scanner above its centre.
constexpr double kSimulateLidarGround = 100 + 128 * (0.5 + 0.5 * 0x1p-21), kAbove = 10;
constexpr std::array<double, 3> kPlace{500064, 4500064, kSimulateLidarGround + kAbove};

/// Where a ray intersects a splat as stored.
double rangeTo(const pro_splat& splat, Vec3 origin, Vec3 direction) {
    const GridPlace place;
    const auto center = place.world(splat.position);
    const Vec3 normal{splat.normal[0], splat.normal[1], splat.normal[2]};
    return dot(normal, Vec3{center[0], center[1], center[2]} - origin) / dot(normal, direction);
}

/// Fires straight down again and again.
LidarSensor plummet(double pulse_hz = 1000) {
    LidarSensor sensor;
    sensor.pattern = LidarTable{{{0, -90, 0, 0}}, pulse_hz};
    sensor.max_range_m = 40;
    sensor.reference_range_m = kAbove;
    return sensor;
}

LidarRun standing(double duration_s = 1) {
    LidarRun run;
    run.trajectory = {{100, kPlace, {0, 0, 0, 1}}};
    run.duration_s = duration_s;
    return run;
}

class Lidar : public testing::Test {
protected:
    const TraceScene& plane() {
        if (!plane_) plane_.emplace(device, std::vector{scan("plane.pro", planeSplats(kSide, 0.5f))});
        return *plane_;
    }
    std::string scan(const std::string& name, const std::vector<pro_splat>& splats) {
        writeScan(folder.file(name), splats, {});
        return folder.file(name);
    }
    static LidarPoints simulate(const TraceScene& scene, const LidarSensor& sensor, const LidarRun& run) {
        LidarPoints all;
        simulateLidar(scene, sensor, run, [&](const LidarPoints& points) { all.append(points); });
        EXPECT_EQ(all.pulses_done, lidarPulseCount(sensor, run));
        EXPECT_EQ(all.pulses_done, all.pulses_total);
        return all;
    }
    static Vec3 positionOf(const LidarPoints& points, std::size_t i) {
        return {points.positions[3 * i], points.positions[3 * i + 1], points.positions[3 * i + 2]};
    }

    TemporaryFolder folder;
    TraceDevice device;

private:
    std::optional<TraceScene> plane_;
};

TEST_F(Lidar, RangesAndIncidencesOfAPlaneMatchTheFormulas) {
    LidarSensor sensor;
    const std::vector<double> elevations{-90, -75, -60, -45, -30, -20, 10};
    sensor.pattern = LidarSpinning{elevations, 10, 2, 0, false};
    sensor.max_range_m = 40;
    sensor.reference_range_m = kAbove;
    LidarRun run = standing();
    run.duration_s = {};
    const LidarPoints points = simulate(plane(), sensor, run);
    EXPECT_EQ(points.pulses_done, 180u * 7);
    ASSERT_EQ(points.size(), 180u * 6); // upward beams hit nothing
    const ProFile file(folder.file("plane.pro"));
    const Vec3 origin{kPlace[0], kPlace[1], kPlace[2]};
    for (std::size_t i = 0; i < points.size(); ++i) {
        const std::size_t ring = i % 6;
        const double down = std::sin(-elevations[ring] * kRadians), range = kAbove / down;
        const double azimuth = 2 * static_cast<double>(i / 6) * kRadians;
        const Vec3 p = positionOf(points, i), direction = (p - origin) * (1 / points.ranges[i]);
        ASSERT_NEAR(length(direction), 1, 1e-8);
        ASSERT_NEAR(points.ranges[i], rangeTo(file.splat(points.splat_ids[i]), origin, direction), 1e-4 * kSplatRadius);
        ASSERT_EQ(points.rings[i], ring);
        ASSERT_EQ(points.pulses[i], i / 6 * 7 + ring);
        // normals are rounded, which tilts the discs
        ASSERT_NEAR(points.ranges[i], range, 1e-3 * kSplatRadius / down) << i;
        ASSERT_NEAR(p.x, kPlace[0] + range * std::cos(elevations[ring] * kRadians) * std::cos(azimuth), 2e-3) << i;
        ASSERT_NEAR(p.y, kPlace[1] + range * std::cos(elevations[ring] * kRadians) * std::sin(azimuth), 2e-3) << i;
        ASSERT_NEAR(p.z, kSimulateLidarGround, 1e-3 * kSplatRadius) << i;
        ASSERT_NEAR(static_cast<double>(points.incidences_deg[i]), 90 + elevations[ring], 0.05) << i; // 16 bit normals
        ASSERT_NEAR(static_cast<double>(points.powers[i]), down * down * down, 1e-3) << i;
        ASSERT_EQ(points.intensities[i], std::lround(4096 * static_cast<double>(points.powers[i]))) << i;
        ASSERT_NEAR(points.times[i], 100 + static_cast<double>(i / 6) / 1800, 1e-9);
        ASSERT_EQ(points.return_numbers[i] + points.numbers_of_returns[i], 2);
        ASSERT_LT(points.splat_ids[i], kSide * kSide);
        ASSERT_EQ(points.instance_ids[i], 0u);
    }
}

TEST_F(Lidar, NoiseHasItsMeanDeviationAndGrowth) {
    LidarSensor sensor = plummet(40000);
    sensor.range_noise_m = 0.03;
    sensor.range_noise_per_m = 0.002;
    const double sigma = 0.03 + 0.002 * kAbove;
    const LidarPoints points = simulate(plane(), sensor, standing());
    const auto count = static_cast<double>(points.size());
    ASSERT_EQ(count, 40000);
    double mean = 0, square = 0, within = 0;
    for (const double range : points.ranges) {
        const double error = range - kAbove;
        mean += error / count;
        square += error * error / count;
        within += std::abs(error) < sigma ? 1 / count : 0;
    }
    EXPECT_NEAR(mean, 0, 4 * sigma / std::sqrt(count));
    EXPECT_NEAR(std::sqrt(square), sigma, 4 * sigma / std::sqrt(2 * count));
    EXPECT_NEAR(within, 0.6827, 4 * std::sqrt(0.6827 * 0.3173 / count));
    for (std::size_t i = 0; i < points.size(); ++i)
        ASSERT_NEAR(positionOf(points, i).z, kSimulateLidarGround + kAbove - points.ranges[i], 1e-8);
}

TEST_F(Lidar, ResultsDoNotDependOnBlocks) {
    LidarSensor sensor = plummet();
    sensor.pattern = LidarSpinning{{-80, -40, -20}, 5, 1, 0, true};
    sensor.divergence_mrad = 20;
    sensor.rays = 7;
    sensor.range_resolution_m = 0.05;
    sensor.range_noise_m = 0.1;
    sensor.drop_probability = 0.3;
    LidarRun run = standing();
    run.seed = 5;
    const LidarPoints at_once = simulate(plane(), sensor, run);
    run.rays_at_once = 100;
    const LidarPoints in_blocks = simulate(plane(), sensor, run);
    EXPECT_EQ(at_once.positions, in_blocks.positions);
    EXPECT_EQ(at_once.powers, in_blocks.powers);
    EXPECT_EQ(at_once.pulses, in_blocks.pulses);
    EXPECT_EQ(at_once.splat_ids, in_blocks.splat_ids);
    run.seed = 6;
    EXPECT_NE(simulate(plane(), sensor, run).pulses, at_once.pulses);
}

TEST_F(Lidar, PulsesAreDroppedWithTheGivenProbability) {
    LidarSensor sensor = plummet(20000);
    sensor.drop_probability = 0.25;
    const LidarPoints points = simulate(plane(), sensor, standing());
    EXPECT_NEAR(static_cast<double>(points.size()), 15000, 4 * std::sqrt(0.25 * 0.75 * 20000));
    sensor.drop_probability = 1;
    EXPECT_EQ(simulate(plane(), sensor, standing()).size(), 0u);
}

TEST_F(Lidar, WeakReturnsAreNotDetected) {
    LidarSensor sensor = plummet();
    std::vector<double> elevations;
    for (int i = 0; i <= 70; ++i) elevations.push_back(-90 + i);
    sensor.pattern = LidarSpinning{elevations, 10, 360, 45, false};
    sensor.detection_threshold = 0.2;
    LidarRun run = standing(0.1);
    const LidarPoints points = simulate(plane(), sensor, run);
    const double lowest = std::asin(std::cbrt(0.2)) / kRadians; // power is the cube of the sine
    const auto seen = std::count_if(elevations.begin(), elevations.end(), [&](double e) { return -e > lowest; });
    EXPECT_EQ(points.size(), static_cast<std::size_t>(seen));
    sensor.range_corrected = true;
    const LidarPoints corrected = simulate(plane(), sensor, run);
    ASSERT_EQ(corrected.size(), points.size());
    for (std::size_t i = 0; i < points.size(); ++i)
        EXPECT_NEAR(corrected.intensities[i], 4096 * std::sin(-elevations[i] * kRadians), 2);
}

/// A disc 50 m below the scanner, 5 m above the ground.
class LidarAndDisc : public Lidar {
protected:
    static constexpr double kHeight = 50, kGap = 5;

    LidarAndDisc() {
        const float level = 0.5f + static_cast<float>(kGap / 128);
        std::vector<pro_splat> splats = planeSplats(kSide, 0.5f);
        splats.push_back({{0.5f, 0.5f, level}, {0, 0, 1}, 0.008f, {200, 200, 200}, 0});
        const std::string path = scan("disc.pro", splats);
        const ProFile file(path);
        while (file.splat(number).position[2] < level - 0.01f) ++number; // splats are in leaf order
        const pro_splat disc = file.splat(number);
        radius = 128 * static_cast<double>(disc.radius);
        for (int axis = 0; axis < 3; ++axis)
            center[axis] = GridPlace{}.origin[axis] + 128 * static_cast<double>(disc.position[axis]);
        scene.emplace(device, std::vector{path});
    }

    /// Fires straight down at this distance from the centre of the disc.
    LidarRun aside(double distance, double duration_s = 0.02) const {
        LidarRun run = standing(duration_s);
        run.trajectory[0].position = {center[0] + distance, center[1], center[2] + kHeight};
        return run;
    }
    LidarSensor wideBeam() const {
        LidarSensor sensor = plummet();
        sensor.max_range_m = 100;
        sensor.reference_range_m = kHeight;
        sensor.divergence_mrad = 80; // 2 m to either side at 50 m
        sensor.rays = 2000;
        sensor.range_resolution_m = 1;
        return sensor;
    }

    /// Share of the beam's power that falls within the disc, summed over rings of the beam.
    double shareOf(double distance) const {
        constexpr int kRings = 4000;
        double share = 0;
        for (int i = 0; i < kRings; ++i) {
            // rings of equal power: each radius encloses its share of the power
            const double inside = (i + 0.5) / kRings,
                         angle = 0.04 * std::sqrt(-0.5 * std::log1p(inside * std::expm1(-2)));
            const double r = kHeight * std::tan(angle);
            // the angle of the circle of radius r that lies in the disc, by its distance from the disc's centre
            const double cosine = (r * r + distance * distance - radius * radius) / (2 * r * std::max(distance, 1e-9));
            share += std::acos(std::clamp(cosine, -1.0, 1.0)) / std::numbers::pi / kRings;
        }
        return share;
    }

    std::optional<TraceScene> scene;
    std::array<double, 3> center{};
    double radius = 0;
    std::uint32_t number = 0;
};

TEST_F(LidarAndDisc, ABeamAcrossAnEdgeGivesTwoReturnsWithTheirShares) {
    for (const double distance : {0.0, 0.5 * radius, radius}) {
        const LidarPoints points = simulate(*scene, wideBeam(), aside(distance));
        ASSERT_EQ(points.size(), 40u) << distance;
        for (std::size_t i = 0; i < points.size(); i += 2) {
            ASSERT_EQ(points.return_numbers[i], 1);
            ASSERT_EQ(points.return_numbers[i + 1], 2);
            ASSERT_EQ(points.numbers_of_returns[i], 2);
            ASSERT_EQ(points.numbers_of_returns[i + 1], 2);
            ASSERT_EQ(points.splat_ids[i], number);
            ASSERT_NE(points.splat_ids[i + 1], number);
            // approximately: rays at the rim of the cone are 0.08% longer
            EXPECT_NEAR(points.ranges[i], kHeight, 1e-3 * kHeight);
            EXPECT_NEAR(points.ranges[i + 1], kHeight + kGap, 1e-3 * kHeight);
            const double first = static_cast<double>(points.powers[i]);
            const double second = static_cast<double>(points.powers[i + 1]) * std::pow((kHeight + kGap) / kHeight, 2);
            // the rim of the disc is exact to a hundredth of its radius
            EXPECT_NEAR(first / (first + second), shareOf(distance), 0.015) << distance;
            EXPECT_NEAR(first + second, 1, 2e-3);
        }
    }
}

TEST_F(LidarAndDisc, FirstLastAndStrongestKeepOneReturn) {
    LidarSensor sensor = wideBeam();
    const auto only = [&](LidarKept kept) {
        sensor.kept = kept;
        const LidarPoints points = simulate(*scene, sensor, aside(0, 0.001));
        EXPECT_EQ(points.size(), 1u);
        EXPECT_EQ(points.return_numbers[0] + points.numbers_of_returns[0], 2);
        return std::lround(points.ranges[0]);
    };
    EXPECT_EQ(only(LidarKept::kFirst), 50);
    EXPECT_EQ(only(LidarKept::kLast), 55);
    EXPECT_EQ(only(LidarKept::kStrongest), shareOf(0) * 1.21 > 1 - shareOf(0) ? 50 : 55); // 1.1^2 for the distances
    sensor.kept = LidarKept::kAll;
    sensor.most_returns = 1;
    EXPECT_EQ(std::lround(simulate(*scene, sensor, aside(0, 0.001)).ranges.at(0)), 50);
    sensor.range_resolution_m = 6; // one echo of both
    sensor.most_returns = 5;
    EXPECT_EQ(simulate(*scene, sensor, aside(0, 0.001)).size(), 1u);
}

TEST_F(LidarAndDisc, RangesAreLimited) {
    LidarSensor sensor = wideBeam();
    sensor.rays = 1;
    sensor.max_range_m = 49.9;
    EXPECT_EQ(simulate(*scene, sensor, aside(0, 0.001)).size(), 0u);
    sensor.max_range_m = 50.1;
    EXPECT_EQ(simulate(*scene, sensor, aside(0, 0.001)).size(), 1u);
    EXPECT_EQ(simulate(*scene, sensor, aside(3, 0.001)).size(), 0u);
    sensor.max_range_m = 100;
    sensor.min_range_m = 51; // the disc hides the ground
    EXPECT_EQ(simulate(*scene, sensor, aside(0, 0.001)).size(), 0u);
    EXPECT_EQ(simulate(*scene, sensor, aside(3, 0.001)).size(), 1u);
}

TEST_F(Lidar, SensorLengthsAreMetresInAnyUnitOfTheScan) {
    LidarSensor sensor = plummet();
    LidarRun run = standing(0.001);
    run.metres_per_unit = 0.3048;
    sensor.max_range_m = 3;
    EXPECT_EQ(simulate(plane(), sensor, run).size(), 0u);
    sensor.max_range_m = 3.1; // 10.17 feet
    sensor.reference_range_m = 3.048;
    const LidarPoints points = simulate(plane(), sensor, run);
    ASSERT_EQ(points.size(), 1u);
    EXPECT_NEAR(points.ranges[0], 10, 1e-3);
    EXPECT_NEAR(static_cast<double>(points.powers[0]), 1, 1e-3);
}

TEST_F(Lidar, AnOscillatingMirrorInFlightDrawsAZigzag) {
    LidarSensor sensor;
    sensor.pattern = LidarOscillating{40, 10, 2000, false};
    sensor.max_range_m = 200;
    LidarRun run;
    const double height = 60;
    // to the north, 40 m in two seconds
    run.trajectory = {{5, {500064, 4500044, kSimulateLidarGround + height}, lidarRotation(90, 0, 0)},
                      {7, {500064, 4500084, kSimulateLidarGround + height}, lidarRotation(90, 0, 0)}};
    const LidarPoints points = simulate(plane(), sensor, run);
    ASSERT_EQ(points.size(), 4000u);
    for (std::size_t i = 0; i < points.size(); ++i) {
        const double time = static_cast<double>(i) / 2000, phase = std::fmod(static_cast<double>(i), 200) / 200;
        const double angle = phase < 0.5 ? -20 + 80 * phase : 60 - 80 * phase;
        const Vec3 p = positionOf(points, i);
        ASSERT_NEAR(static_cast<double>(points.scan_angles_deg[i]), angle, 1e-4);
        ASSERT_NEAR(points.times[i], 5 + time, 1e-9);
        ASSERT_NEAR(p.x, 500064 + height * std::tan(angle * kRadians), 2e-3) << i; // east is right of north
        ASSERT_NEAR(p.y, 4500044 + 20 * time, 2e-3) << i;
    }
    run.start_s = 6;
    run.duration_s = 0.5;
    const LidarPoints part = simulate(plane(), sensor, run);
    ASSERT_EQ(part.size(), 1000u);
    EXPECT_NEAR(part.times.front(), 6, 1e-12);
    EXPECT_NEAR(positionOf(part, 0).y, 4500064, 2e-3);
}

TEST_F(Lidar, ReflectancesComeFromColorsOrAttributes) {
    std::vector<pro_splat> splats = planeSplats(2, 0.5f);
    splats[1].color[0] = 255, splats[1].color[1] = 0, splats[1].color[2] = 0;
    Scene colored = sceneOf(splats);
    colored.info.flags |= PRO_FLAG_COLOR;
    colored.write(folder.file("colored.pro"));
    const std::vector<std::uint32_t> ids{0, 1, 2, 3}, none(4, 0);
    std::vector<float> seen(4);
    const TraceScene scene(device, {folder.file("colored.pro")});
    ReflectanceLookup(scene, {}).lookUp({ids, none, {}}, seen);
    std::sort(seen.begin(), seen.end()); // splats are in leaf order
    EXPECT_FLOAT_EQ(seen[0], 0.2126f);
    EXPECT_NEAR(static_cast<double>(seen[3]), std::pow((200 / 255.0 + 0.055) / 1.055, 2.4), 1e-6);
    ReflectanceLookup(scene, {LidarReflectance::Source::kConstant, 0.25, "", 0}).lookUp({ids, none, {}}, seen);
    EXPECT_EQ(seen, std::vector<float>(4, 0.25f));

    const TraceScene numbered(device, {POINTRT_GOLDEN_DIR "/tiny_compact_scan.pro"}); // tests/format/tiny_attributes.h
    const std::vector<std::uint32_t> some{3, 1, 0, kNoHit}, first{0, 0, 0, kNoHit};
    ReflectanceLookup(numbered, {}).lookUp({some, first, {}}, seen);
    EXPECT_EQ(seen, (std::vector<float>{300.0f / 65535, 1, 0, 0}));
    ReflectanceLookup(numbered, {LidarReflectance::Source::kAttribute, 1, "intensity", 400})
        .lookUp({some, first, {}}, seen);
    EXPECT_EQ(seen, (std::vector<float>{0.75f, 1, 0, 0}));
    try {
        ReflectanceLookup(numbered, {LidarReflectance::Source::kAttribute, 1, "gloss", 0});
        ADD_FAILURE();
    } catch (const TraceError& error) {
        EXPECT_SAYS(error.what(), "*attribute gloss*intensity, ");
    }
}

/// The error of simulateLidar for an invalid sensor or run.
std::string refusalOf(const LidarSensor& sensor, const LidarRun& run) {
    try {
        lidarPulseCount(sensor, run);
    } catch (const TraceError& error) {
        EXPECT_EQ(error.kind, TraceError::Kind::kBadUsage);
        return error.what();
    }
    return "nothing was thrown";
}

TEST(LidarCheck, InvalidSensorsAreNamedByTheirMember) {
    const double nan = std::nan("");
    const auto refusal = [](auto change) {
        LidarSensor sensor = plummet();
        change(sensor);
        return refusalOf(sensor, standing());
    };
    EXPECT_SAYS(refusal([](LidarSensor& s) {
                    s.pattern = LidarSpinning{{0}, -1, 1, 0, false};
                }),
                "rotation_hz *-1*1e-06 *1e+09");
    EXPECT_SAYS(refusal([](LidarSensor& s) {
                    s.pattern = LidarSpinning{{}, 1, 1, 0, false};
                }),
                "the number of elevations_deg *0*1 *65536");
    EXPECT_SAYS(refusal([](LidarSensor& s) {
                    s.pattern = LidarSpinning{{91}, 1, 1, 0, false};
                }),
                "elevations_deg *91*-90 *90");
    EXPECT_SAYS(refusal([](LidarSensor& s) { s.pattern = LidarFlash{0, 1, 10, 10, 1}; }), "width *0*1 *65536");
    EXPECT_SAYS(refusal([](LidarSensor& s) { s.pattern = LidarTable{{}, 1}; }), "the number of beams *0*1 *16777216");
    EXPECT_SAYS(refusal([](LidarSensor& s) { s.pattern = LidarTable{{{0, 0, 0, 2}}, 1}; }), "delay_s *2*0 *1");
    EXPECT_SAYS(refusal([&](LidarSensor& s) { s.max_range_m = nan; }), "max_range_m *nan*1e-06 *1e+09");
    EXPECT_SAYS(refusal([](LidarSensor& s) { s.min_range_m = 50; }), "min_range_m *below max_range_m");
    EXPECT_SAYS(refusal([](LidarSensor& s) { s.rays = 0; }), "rays *0*1 *4096");
    EXPECT_SAYS(refusal([](LidarSensor& s) { s.rays = 5; }), "range_resolution_m *0*1e-06 *1e+09");
    EXPECT_SAYS(refusal([](LidarSensor& s) { s.most_returns = 16; }), "most_returns *16*1 *15");
    EXPECT_SAYS(refusal([](LidarSensor& s) { s.drop_probability = 1.5; }), "drop_probability *1.5*0 *1");
    EXPECT_SAYS(refusal([](LidarSensor& s) {
                    s.pattern = LidarFlash{65536, 65536, 10, 10, 1e9};
                }),
                "*1.000000 s *pulses");
}

TEST(LidarCheck, InvalidRunsAreRefused) {
    const double nan = std::nan("");
    const auto refusal = [](auto change) {
        LidarRun run = standing();
        run.trajectory.push_back({102, kPlace, {0, 0, 0, 1}});
        change(run);
        return refusalOf(plummet(), run);
    };
    EXPECT_SAYS(refusal([](LidarRun& r) { r.trajectory.clear(); }), "*trajectory *no pose");
    EXPECT_SAYS(refusal([](LidarRun& r) { r.trajectory[1].time = 100; }), "pose 1: *time *later");
    EXPECT_SAYS(refusal([&](LidarRun& r) { r.trajectory[0].position[2] = nan; }), "pose 0: *position *finite");
    EXPECT_SAYS(refusal([](LidarRun& r) { r.trajectory[1].rotation = {}; }), "pose 1: *quaternion");
    EXPECT_SAYS(refusal([](LidarRun& r) { r.duration_s = 0; }), "duration_s *above 0");
    EXPECT_SAYS(refusal([](LidarRun& r) { r.start_s = 102; }), "start_s *102*100 *102 s");
    EXPECT_SAYS(refusal([](LidarRun& r) { r.duration_s = 3; }), "*ends *103 s*100 *102 s");
}

} // namespace
} // namespace pointrt::test

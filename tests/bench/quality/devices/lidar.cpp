// SPDX-License-Identifier: Apache-2.0
#include <tbb/parallel_for.h>

#include <limits>
#include <numbers>

#include "tests/bench/quality/devices/beam.h"
#include "tests/bench/quality/devices/devices.h"

namespace pointrt::quality {

namespace {

constexpr double kRadians = std::numbers::pi / 180;
const Vec3d kNothing = Vec3d::Constant(std::numeric_limits<double>::quiet_NaN());

Vec3d directionOf(double azimuth_deg, double elevation_deg) {
    const double azimuth = azimuth_deg * kRadians, elevation = elevation_deg * kRadians;
    return {std::cos(elevation) * std::cos(azimuth), std::cos(elevation) * std::sin(azimuth), std::sin(elevation)};
}

Vec3d normalVector(double size, Random& random) {
    return size * Vec3d(random.normal(), random.normal(), random.normal());
}

} // namespace

GridScan scanByTerrestrial(const WorldTracing& world, const TerrestrialScanner& device, const Vec3d& station,
                           std::uint64_t seed) {
    const auto rows = static_cast<std::size_t>((90 - device.lowest_deg) / device.step_deg);
    const auto columns = static_cast<std::size_t>(360 / device.step_deg);
    GridScan scan{rows, columns, std::vector<Vec3d>(rows * columns, kNothing)};
    Random placing(seed);
    scan.world_from_device.translation() = station + normalVector(device.pose_offset, placing);
    const Beam beam{device.exit_radius, device.half_divergence, 1};
    tbb::parallel_for(std::size_t{0}, scan.samples.size(), [&](std::size_t i) {
        Random random(seed + 1, i);
        const double elevation =
            90 - (static_cast<double>(i / columns) + 0.5) * device.step_deg; // rows from the zenith
        const Vec3d direction = directionOf(static_cast<double>(i % columns) * device.step_deg, elevation);
        const auto echoes = echoesOf(world, beam, station, direction, device.farthest);
        if (totalPower(echoes) < device.least_power) return;
        const double range = grouped(echoes, std::numeric_limits<double>::infinity()).front().range;
        if (range >= device.nearest) scan.samples[i] = (range + device.noise * random.normal()) * direction;
    });
    return scan;
}

std::vector<Return> scanByAirborne(const WorldTracing& world, const AirborneScanner& device, double half,
                                   std::uint64_t seed) {
    constexpr int kStrips = 2;
    const auto across = static_cast<std::size_t>(2 * half / device.pitch);
    const Beam beam{0, device.half_divergence, 2};
    std::vector<Return> returns;
    for (int strip = 0; strip < kStrips; ++strip) {
        Random placing(seed, static_cast<std::uint64_t>(strip));
        const Vec3d offset = normalVector(device.pose_offset, placing);
        // strips are so far apart that the second sees the square from the other side, at half its angle
        const double aside = (strip == 0 ? 1 : -1) * device.altitude * std::tan(device.half_scan_deg / 2 * kRadians);
        std::vector<std::vector<Return>> pulses(across * across);
        tbb::parallel_for(std::size_t{0}, pulses.size(), [&](std::size_t i) {
            Random random(seed + 1 + static_cast<std::uint64_t>(strip), i);
            const double x = (static_cast<double>(i / across) + random.uniform()) * device.pitch - half;
            const double y = (static_cast<double>(i % across) + random.uniform()) * device.pitch - half;
            const Vec3d origin(x, aside, device.altitude);
            const Vec3d direction = (Vec3d(x, y, 0) - origin).normalized();
            auto groups = grouped(echoesOf(world, beam, origin, direction, 2 * device.altitude), device.resolution);
            std::erase_if(groups, [&](const Echo& echo) { return echo.power < device.least_power; });
            for (std::size_t k = 0; k < std::min<std::size_t>(groups.size(), 7); ++k) // the limit of LAS
                pulses[i].push_back({origin + offset + (groups[k].range + device.noise * random.normal()) * direction,
                                     static_cast<int>(k + 1),
                                     static_cast<int>(std::min<std::size_t>(groups.size(), 7))});
        });
        for (const auto& pulse : pulses) returns.insert(returns.end(), pulse.begin(), pulse.end());
    }
    return returns;
}

std::vector<Vec3d> scanBySpinning(const WorldTracing& world, const SpinningLidar& device,
                                  const std::vector<Vec3d>& places, std::uint64_t seed) {
    const auto steps = static_cast<std::size_t>(360 / device.azimuth_step_deg);
    const auto rings = static_cast<std::size_t>(device.rings);
    const Beam beam{0, device.half_divergence, 1};
    std::vector<Vec3d> points;
    for (std::size_t turn = 0; turn < places.size(); ++turn) {
        Random placing(seed, turn);
        const Vec3d offset = normalVector(device.pose_offset, placing);
        const Eigen::AngleAxisd heading(device.pose_turn_deg * kRadians * placing.normal(), Vec3d::UnitZ());
        std::vector<Vec3d> samples(steps * rings, kNothing);
        tbb::parallel_for(std::size_t{0}, samples.size(), [&](std::size_t i) {
            Random random(seed + 1 + turn, i);
            const double ring = static_cast<double>(i % rings) / static_cast<double>(rings - 1);
            const Vec3d direction = directionOf(static_cast<double>(i / rings) * device.azimuth_step_deg,
                                                device.top_deg + ring * (device.bottom_deg - device.top_deg));
            Echo strongest{0, device.least_power};
            for (const Echo& echo :
                 grouped(echoesOf(world, beam, places[turn], direction, device.farthest), device.resolution))
                if (echo.power >= strongest.power) strongest = echo;
            if (strongest.range < device.nearest) return;
            samples[i] =
                places[turn] + offset + (strongest.range + device.noise * random.normal()) * (heading * direction);
        });
        for (const Vec3d& sample : samples)
            if (isTaken(sample)) points.push_back(sample);
    }
    return points;
}

} // namespace pointrt::quality

// SPDX-License-Identifier: Apache-2.0
#include <tbb/parallel_for.h>

#include <limits>

#include "tests/bench/quality/devices/devices.h"

namespace pointrt::quality {

namespace {

Vec3d sampleOf(const WorldTracing& world, const DepthCamera& device, int row, int column, Random& random) {
    const auto direction = [&](double down, double right) {
        return Vec3d((right - device.columns / 2.0) / device.focal, (down - device.rows / 2.0) / device.focal, 1);
    };
    const Vec3d nothing = Vec3d::Constant(std::numeric_limits<double>::quiet_NaN());
    const double down = row + 0.5, right = column + 0.5;
    const Vec3d sight =
        direction(down + device.lateral_pixels * random.normal(), right + device.lateral_pixels * random.normal());
    const auto hit = world.firstHit(Vec3d::Zero(), sight.normalized());
    if (!hit) return nothing;
    const double depth = hit->range / sight.norm();
    const Vec3d place = hit->range * sight.normalized() + 1e-3 * hit->normal;
    if (depth < device.nearest || depth > device.farthest) return nothing;
    if (!world.isFree(place, {device.base, 0, 0})) return nothing; // in the projector's shadow
    return quantizedDepth(device, depth, device.noise_steps * random.normal()) * direction(down, right);
}

} // namespace

double quantizedDepth(const DepthCamera& device, double depth, double error_steps) {
    return 1 / (device.step * std::round(1 / (device.step * depth) + error_steps));
}

GridScan scanByDepthCamera(const WorldTracing& world, const DepthCamera& device, std::uint64_t seed) {
    GridScan scan{static_cast<std::size_t>(device.rows), static_cast<std::size_t>(device.columns), {}};
    scan.samples.resize(scan.rows * scan.columns);
    tbb::parallel_for(std::size_t{0}, scan.samples.size(), [&](std::size_t i) {
        Random random(seed, i);
        scan.samples[i] =
            sampleOf(world, device, static_cast<int>(i / scan.columns), static_cast<int>(i % scan.columns), random);
    });
    return scan;
}

} // namespace pointrt::quality

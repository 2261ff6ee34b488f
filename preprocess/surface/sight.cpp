// SPDX-License-Identifier: GPL-3.0-or-later
#include "preprocess/surface/sight.h"

#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>
#include <limits>
#include <numeric>

#include "preprocess/cloud/clean_noise.h"
#include "preprocess/surface/sight_map.h"

namespace pointrt::surface {
namespace {

/// What lies this near to the disc's plane may be the disc's own surface, in standard deviations.
constexpr float kSigmas = 5;
/// The same of clean clouds, whose noise is not known place by place but below kCleanNoise spacings.
constexpr float kClean = kSigmas * kCleanNoise;

/// Over the distance from the disc's middle to where a sight passes its plane: a surface of a radius of curvature as
/// small as the disc's own lies half the disc's radius behind its rim, half the distance squared over the radius.
constexpr float kCurved = 0.5f;

/// Sine of the angle that a surface seen beside the disc's middle makes with its plane: normals err by less, and what
/// is seen at a grazing angle is taken for the disc's own surface. At 0.2 the simulated house has 0.064% of holes
/// instead of 0.048% (without lines of sight 0.045%), at 0.3 normals of walls are 0.3 degrees worse.
constexpr float kTilted = 0.3f;

/// Sensors of other scans: how many sights it takes, and how far behind the disc what they see must be, in radii.
/// Measured with a station 6 cm off: no more holes than without the others (0.078% and 0.077%).
constexpr std::size_t kOtherSights = 3;
constexpr float kOtherClear = 0.5f;

/// Share of a surface (sheetShares) below which a point's disc may stand for leaves around it. It is as wide as what
/// lets through as many sights as the crown does; ended at the nearest as well, it would let through too many: of the
/// simulated house's trees 44% in truth, 53% then, 52% with a share of 0.5, 48% with 1.
constexpr float kSheet = 1.0f;

/// Beside its own as many sensors as stand nearest look at a disc: each costs as much.
constexpr std::size_t kMostOthers = 8;

/// A scanner's sights stand apart by the spacing of what they see. Of a cloud put together of many scans the far side
/// shows between the points of the near one, anywhere. Such a sight, within a quarter of the way to the second
/// neighbour, have 5.5% of the points of the Bunny's ten scans taken for one, and of true sensors' 0.01 to 0.5%; of a
/// scanner that tells several points of a pulse, among trees, 2.9%.
constexpr float kInside = 0.25f;
constexpr double kMostInside = 0.04;

/// A sensor whose points lie all within so many radians of their mean direction is a direction: it was put at ten
/// diagonals, from where half a diagonal takes atan(1/20), and the mean may lie as far out.
constexpr float kDirection = 0.1f;

constexpr std::uint32_t kNone = std::numeric_limits<std::uint32_t>::max();

struct Sensor {
    Vec3f place;
    SightMap map;
    std::vector<std::uint32_t> others; ///< numbers of those nearest to it
};

struct Job {
    const Points& points;
    const NeighborLists& lists;
    const std::vector<float>&noise, &sheets;
    std::vector<Sensor> sensors;
    std::vector<std::uint32_t> number; ///< [points.sensors], in sensors or kNone

    std::uint32_t sensorOf(std::size_t point) const {
        return points.sensorOf(point) ? number[points.sensor_of_point[point]] : kNone;
    }
    bool isScattered(std::size_t point) const { return !sheets.empty() && sheets[point] < kSheet; }
    float halfWay(std::size_t point) const {
        return lists.distance(points, point, std::min<std::size_t>(1, lists.k - 1)) / 2;
    }
};

/// Whether a sensor, from which these points were seen, stands for a direction; or saw nothing.
bool isDirection(const std::vector<Vec3f>& seen) {
    Vec3f mean = Vec3f::Zero();
    for (const Vec3f& each : seen) mean += each.normalized();
    mean.normalize();
    const float least = std::cos(kDirection);
    return std::all_of(seen.begin(), seen.end(),
                       [&](const Vec3f& each) { return mean.dot(each) >= least * each.norm(); });
}

void findOthers(std::vector<Sensor>& sensors) {
    std::vector<std::uint32_t> order(sensors.size());
    for (Sensor& sensor : sensors) {
        std::iota(order.begin(), order.end(), 0u);
        const auto away = [&](std::uint32_t other) { return squaredDistance(sensors[other].place, sensor.place); };
        const auto self = std::uint32_t(&sensor - sensors.data());
        std::erase(order, self);
        const std::size_t count = std::min(order.size(), kMostOthers);
        std::partial_sort(
            order.begin(), order.begin() + std::ptrdiff_t(count), order.end(),
            [&](std::uint32_t a, std::uint32_t b) { return std::pair(away(a), a) < std::pair(away(b), b); });
        sensor.others.assign(order.begin(), order.begin() + std::ptrdiff_t(count));
        order.resize(sensors.size());
    }
}

Job makeJob(const Points& points, std::size_t measured, const NeighborLists& lists, const std::vector<float>& noise,
            const std::vector<float>& sheets) {
    std::vector<std::vector<Vec3f>> seen(points.sensors.size());
    for (std::size_t i = 0; i < measured; ++i)
        if (const Vec3f* sensor = points.sensorOf(i))
            seen[points.sensor_of_point[i]].push_back(points.positions[i] - *sensor);
    Job job{points, lists, noise, sheets, {}, std::vector<std::uint32_t>(seen.size(), kNone)};
    for (std::size_t i = 0; i < seen.size(); ++i) {
        if (isDirection(seen[i])) continue;
        job.number[i] = std::uint32_t(job.sensors.size());
        job.sensors.push_back({points.sensors[i], SightMap(seen[i]), {}});
    }
    findOthers(job.sensors);
    return job;
}

/// Distances, nearest first, from the middle of a point's disc to where lines of sight pass through it to what lies
/// clearly behind; radius where there are fewer.
template <std::size_t kCount>
std::array<float, kCount> nearestSights(const Job& job, std::size_t point, const Sensor& sensor, float radius,
                                        float clear) {
    const Vec3f center = job.points.positions[point] - sensor.place, normal = job.points.normals[point];
    const float side = normal.dot(center), plane = std::abs(side);
    const Vec3f ahead = side < 0 ? Vec3f(-normal) : normal;
    const Vec3f extent = radius * (Vec3f::Ones() - normal.cwiseAbs2()).cwiseMax(0).cwiseSqrt();
    std::array<float, kCount> nearest;
    nearest.fill(radius * radius);
    sensor.map.forSights({center - extent, center + extent}, [&](const Vec3f& seen) {
        const float along = ahead.dot(seen), beyond = along - plane;
        if (!(beyond > clear)) return;
        const float squared = (seen * (plane / along) - center).squaredNorm();
        if (squared >= nearest.back()) return;
        const float least = std::max(kCurved * kCurved * squared, kTilted * kTilted * (seen - center).squaredNorm());
        if (beyond * beyond < least) return;
        std::size_t at = kCount - 1;
        for (; at > 0 && nearest[at - 1] > squared; --at) nearest[at] = nearest[at - 1];
        nearest[at] = squared;
    });
    for (float& each : nearest) each = std::sqrt(each);
    return nearest;
}

float ownClear(const Job& job, std::size_t point) {
    const float sigma = job.noise.empty() ? 0 : job.noise[point];
    return std::max(kSigmas * sigma, kClean * job.lists.spacings[point]);
}

/// [points], where the nearest sight of its own sensor passes its disc, or its radius.
std::vector<float> ownSights(const Job& job, const std::vector<float>& radii, const StageShare& share) {
    std::vector<float> nearest = radii;
    forEach(radii.size(), share, [&](std::size_t i) {
        if (const std::uint32_t own = job.sensorOf(i); own != kNone)
            nearest[i] = nearestSights<1>(job, i, job.sensors[own], radii[i], ownClear(job, i)).front();
    });
    return nearest;
}

/// [sensors], 1 where few of its points have a sight so near that it must be another scanner's.
std::vector<std::uint8_t> believable(const Job& job, const std::vector<float>& nearest, std::size_t measured) {
    std::vector<std::size_t> points(job.sensors.size()), inside(job.sensors.size());
    for (std::size_t i = 0; i < measured; ++i) {
        const std::uint32_t own = job.sensorOf(i);
        if (own == kNone) continue;
        ++points[own];
        inside[own] += nearest[i] < kInside * 2 * job.halfWay(i);
    }
    std::vector<std::uint8_t> believed(job.sensors.size());
    for (std::size_t i = 0; i < believed.size(); ++i)
        believed[i] = double(inside[i]) <= kMostInside * double(points[i]);
    return believed;
}

float endedRadius(const Job& job, std::size_t point, float radius, float own_nearest,
                  const std::vector<std::uint8_t>& believed) {
    const std::uint32_t own = job.sensorOf(point);
    if (own == kNone || job.isScattered(point)) return radius;
    const float least = std::min(job.halfWay(point), radius);
    if (believed[own]) radius = std::max(own_nearest, least);
    for (const std::uint32_t other : job.sensors[own].others) {
        if (!believed[other] || radius <= least) continue;
        const float clear = std::max(ownClear(job, point), kOtherClear * radius);
        radius = std::max(least, nearestSights<kOtherSights>(job, point, job.sensors[other], radius, clear).back());
    }
    return radius;
}

} // namespace

std::size_t endAtSights(const Points& points, std::size_t measured, const NeighborLists& lists,
                        const std::vector<float>& noise, const std::vector<float>& sheets, std::vector<float>& radii,
                        const StageShare& share) {
    if (points.sensors.empty()) return 0;
    const Job job = makeJob(points, measured, lists, noise, sheets);
    if (job.sensors.empty()) return 0;
    const std::vector<float> own_nearest = ownSights(job, radii, share);
    const std::vector<std::uint8_t> believed = believable(job, own_nearest, measured);
    std::atomic<std::size_t> shrunk{0};
    forEach(radii.size(), share, [&](std::size_t i) {
        const float radius = endedRadius(job, i, radii[i], own_nearest[i], believed);
        shrunk += radius < radii[i];
        radii[i] = radius;
    });
    return shrunk;
}

} // namespace pointrt::surface

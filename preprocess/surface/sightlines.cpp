// SPDX-License-Identifier: GPL-3.0-or-later
#include "preprocess/surface/sightlines.h"

#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>
#include <limits>
#include <numeric>

#include "preprocess/cloud/clean_noise.h"
#include "preprocess/surface/sightline_map.h"

namespace pointrt::surface {
namespace {

/// A point this close to the disc's plane, in standard deviations, may be on the disc's own surface.
constexpr float kSigmas = 5;
/// The same for clean clouds, whose local noise is unknown but below kCleanNoise spacings.
constexpr float kClean = kSigmas * kCleanNoise;

/// A sightline shows a disc to be wrong only if its point lies deeper behind the disc's plane than this share of the
/// distance between the disc's centre and the place where the sightline crosses the plane. A curved surface may be that
/// deep itself: one whose radius of curvature is the disc's radius lies half a radius behind the plane at the disc's
/// edge (distance^2 / (2 radius)).
constexpr float kCurved = 0.5f;

/// Sine of the angle at the disc's centre between its plane and the point behind: normals err by less, and a point at a
/// smaller angle counts as the disc's own surface. At 0.2 the simulated house has 0.064% of holes instead of 0.048%
/// (0.045% without sightlines), at 0.3 normals of walls are 0.3 degrees worse.
constexpr float kTilted = 0.3f;

/// Sensors of other scans: number of sightlines needed, and least distance behind the disc, in radii. With a station 6
/// cm off, they add no holes (0.078% with, 0.077% without).
constexpr std::size_t kOtherSightlines = 3;
constexpr float kOtherClear = 0.5f;

/// Planarity weight below which discs stay. Discs of foliage already pass as many sightlines as the crown does
/// (radii.cpp); shrunk in addition, they would pass too many: 53% through the simulated house's trees, 52% with a limit
/// of 0.5, 48% with 1, where 44% is true.
constexpr float kFullyPlanar = 1.0f;

/// Maximum number of sensors tested per disc besides its own, the nearest to its own first: each costs the same time.
constexpr std::size_t kMostOthers = 8;

/// A scanner's sightlines are as far apart as the points it sees. In a cloud merged from many scans, the far side shows
/// through between points of the near side, anywhere. A sightline passes within a quarter of the distance to the second
/// neighbour for 5.5% of the points of the Bunny's ten scans merged into one, for 0.01 to 0.5% with true sensors, and
/// for 2.9% with a scanner that records several returns per pulse, among trees.
constexpr float kInside = 0.25f;
constexpr double kMostInside = 0.04;

/// A sensor represents a direction if all its points are within this many radians of their mean direction: it is placed
/// at ten diagonals, from where half a diagonal subtends atan(1/20), and the mean may be off by as much.
constexpr float kDirection = 0.1f;

constexpr std::uint32_t kNone = std::numeric_limits<std::uint32_t>::max();

struct Sensor {
    Vec3f place;
    SightlineMap map;
    std::vector<std::uint32_t> others; ///< indices of the nearest other sensors
};

struct Job {
    const PointGraph& graph;
    std::size_t measured;
    std::vector<Sensor> sensors;
    std::vector<std::uint32_t> sensor_index; ///< [points.sensors], into sensors, or kNone

    std::uint32_t sensorOf(std::size_t point) const {
        return graph.points.sensorOf(point) ? sensor_index[graph.points.sensor_of_point[point]] : kNone;
    }
    bool isScattered(std::size_t point) const {
        return !graph.points.planarity.empty() && graph.points.planarity[point] < kFullyPlanar;
    }
    float toSecondNeighbor(std::size_t point) const {
        return graph.lists.distance(graph.points, point, std::min<std::size_t>(1, graph.lists.k - 1));
    }
};

/// Whether a sensor represents a direction, or saw nothing. seen: the points that it saw, relative to it.
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

Job makeJob(const PointGraph& graph, std::size_t measured) {
    const PointSet& points = graph.points;
    std::vector<std::vector<Vec3f>> seen(points.sensors.size());
    for (std::size_t i = 0; i < measured; ++i)
        if (const Vec3f* sensor = points.sensorOf(i))
            seen[points.sensor_of_point[i]].push_back(points.positions[i] - *sensor);
    Job job{graph, measured, {}, std::vector<std::uint32_t>(seen.size(), kNone)};
    for (std::size_t i = 0; i < seen.size(); ++i) {
        if (isDirection(seen[i])) continue;
        job.sensor_index[i] = std::uint32_t(job.sensors.size());
        job.sensors.push_back({points.sensors[i], SightlineMap(seen[i]), {}});
    }
    findOthers(job.sensors);
    return job;
}

/// Distances, nearest first, from the centre of a point's disc to where sightlines to points clearly behind it pass
/// through; radius if there are fewer.
template <std::size_t kCount>
std::array<float, kCount> nearestSightlines(const Job& job, std::size_t point, const Sensor& sensor, float radius,
                                            float clear) {
    const PointSet& points = job.graph.points;
    const Vec3f center = points.positions[point] - sensor.place, normal = points.normals[point];
    const float side = normal.dot(center), plane = std::abs(side);
    const Vec3f ahead = side < 0 ? Vec3f(-normal) : normal;
    const Vec3f extent = radius * (Vec3f::Ones() - normal.cwiseAbs2()).cwiseMax(0).cwiseSqrt();
    std::array<float, kCount> nearest;
    nearest.fill(radius * radius);
    sensor.map.forSightlines({center - extent, center + extent}, [&](const Vec3f& seen) {
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

/// Least distance behind a disc at which a point seen by the disc's own sensor counts as behind it.
float clearance(const Job& job, std::size_t point) {
    const std::vector<float>& noise = job.graph.points.noise;
    const float sigma = noise.empty() ? 0 : noise[point];
    return std::max(kSigmas * sigma, kClean * job.graph.lists.spacings[point]);
}

/// [points], the distance at which the nearest sightline of its own sensor passes through its disc, or its radius.
std::vector<float> ownSightlines(const Job& job, const StageShare& share) {
    const std::vector<float>& radii = job.graph.points.radii;
    std::vector<float> nearest = radii;
    forEach(radii.size(), share, [&](std::size_t i) {
        if (const std::uint32_t own = job.sensorOf(i); own != kNone)
            nearest[i] = nearestSightlines<1>(job, i, job.sensors[own], radii[i], clearance(job, i)).front();
    });
    return nearest;
}

/// [sensors], 1 if the sensor is consistent with the points attributed to it: its sightlines pass right beside few of
/// them. A surface that a scanner has measured blocks its sightlines, so points that do not were measured by another.
std::vector<std::uint8_t> consistentSensors(const Job& job, const std::vector<float>& nearest) {
    std::vector<std::size_t> points(job.sensors.size()), inside(job.sensors.size());
    for (std::size_t i = 0; i < job.measured; ++i) {
        const std::uint32_t own = job.sensorOf(i);
        if (own == kNone) continue;
        ++points[own];
        inside[own] += nearest[i] < kInside * job.toSecondNeighbor(i);
    }
    std::vector<std::uint8_t> consistent(job.sensors.size());
    for (std::size_t i = 0; i < consistent.size(); ++i)
        consistent[i] = double(inside[i]) <= kMostInside * double(points[i]);
    return consistent;
}

/// The radius of a disc that clears all sightlines of consistent sensors.
float clearRadius(const Job& job, std::size_t point, float own_nearest, const std::vector<std::uint8_t>& consistent) {
    float radius = job.graph.points.radii[point];
    const std::uint32_t own = job.sensorOf(point);
    if (own == kNone || job.isScattered(point)) return radius;
    const float least = std::min(job.toSecondNeighbor(point) / 2, radius);
    if (consistent[own]) radius = std::max(own_nearest, least);
    for (const std::uint32_t other : job.sensors[own].others) {
        if (!consistent[other] || radius <= least) continue;
        const float clear = std::max(clearance(job, point), kOtherClear * radius);
        radius =
            std::max(least, nearestSightlines<kOtherSightlines>(job, point, job.sensors[other], radius, clear).back());
    }
    return radius;
}

} // namespace

std::size_t clearSightlines(PointGraph& graph, std::size_t measured, const StageShare& share) {
    if (graph.points.sensors.empty()) return 0;
    const Job job = makeJob(graph, measured);
    if (job.sensors.empty()) return 0;
    std::vector<float>& radii = graph.points.radii;
    const std::vector<float> own_nearest = ownSightlines(job, share);
    const std::vector<std::uint8_t> consistent = consistentSensors(job, own_nearest);
    std::atomic<std::size_t> shrunk{0};
    forEach(radii.size(), share, [&](std::size_t i) {
        const float radius = clearRadius(job, i, own_nearest[i], consistent);
        shrunk += radius < radii[i];
        radii[i] = radius;
    });
    return shrunk;
}

} // namespace pointrt::surface

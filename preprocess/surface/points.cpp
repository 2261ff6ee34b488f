// SPDX-License-Identifier: GPL-3.0-or-later
#include "preprocess/surface/points.h"

#include <cmath>
#include <tbb/parallel_for.h>
#include <tbb/parallel_sort.h>
#include <tuple>

#include "preprocess/cloud/bounds.h"
#include "preprocess/cloud/keep_flagged.h"
#include "preprocess/cloud/morton.h"

namespace pointrt::surface {
namespace {

struct CurvePoint {
    std::uint64_t code;
    std::uint32_t index;
};

std::uint64_t codeOf(const Vec3f& position, const Bounds& bounds, double steps_per_unit) {
    const auto steps = [&](int axis) {
        return std::uint64_t((double(position[axis]) - bounds.low[axis]) * steps_per_unit);
    };
    return mortonCode(steps(0), steps(1), steps(2));
}

std::vector<CurvePoint> sortAlongCurve(const std::vector<Vec3f>& positions, const Bounds& bounds) {
    constexpr double kSteps = double((1 << kMortonBits) - 1);
    const double steps_per_unit = kSteps / bounds.longestEdge();
    std::vector<CurvePoint> order(positions.size());
    tbb::parallel_for(std::size_t(0), order.size(), [&](std::size_t i) {
        order[i] = {codeOf(positions[i], bounds, steps_per_unit), std::uint32_t(i)};
    });
    const auto key = [&](const CurvePoint& point) {
        const Vec3f& p = positions[point.index];
        return std::make_tuple(p.x(), p.y(), p.z(), point.index);
    };
    tbb::parallel_sort(order, [&](const CurvePoint& a, const CurvePoint& b) {
        return a.code != b.code ? a.code < b.code : key(a) < key(b);
    });
    return order;
}

/// Cloud indices along the curve, the first of each run of equal positions.
std::vector<std::uint32_t> distinctIndices(const std::vector<Vec3f>& positions, const Bounds& bounds) {
    std::vector<std::uint32_t> distinct;
    distinct.reserve(positions.size());
    for (const CurvePoint& point : sortAlongCurve(positions, bounds))
        if (distinct.empty() || positions[distinct.back()] != positions[point.index]) distinct.push_back(point.index);
    return distinct;
}

template <typename T>
std::vector<T> gatherAndFree(std::vector<T>& source, const std::vector<std::uint32_t>& indices) {
    std::vector<T> gathered;
    if (source.empty()) return gathered;
    gathered.resize(indices.size());
    tbb::parallel_for(std::size_t(0), indices.size(), [&](std::size_t i) { gathered[i] = source[indices[i]]; });
    std::vector<T>().swap(source);
    return gathered;
}

template <typename T, typename Body>
void forAll(std::vector<T>& values, const Body& body) {
    tbb::parallel_for(std::size_t(0), values.size(), [&](std::size_t i) { body(values[i]); });
}

Vec3f scaled(const Vec3f& vector, double factor) { return (vector.cast<double>() * factor).cast<float>(); }

/// Unit length, or zero for what is no direction.
Vec3f unitOrZero(const Vec3f& normal) {
    const Vec3d wide = normal.cast<double>();
    const double length = wide.norm();
    if (!std::isfinite(length) || length == 0) return Vec3f::Zero();
    return (wide / length).cast<float>();
}

/// Scales positions and sensors, so far of this extent, by a power of two: no bit is lost.
void toUnitSize(Points& points, double extent) {
    int exponent;
    std::frexp(extent, &exponent);
    const double factor = std::ldexp(1.0, -exponent);
    forAll(points.positions, [&](Vec3f& position) { position = scaled(position, factor); });
    for (Vec3f& sensor : points.sensors) sensor = scaled(sensor, factor);
    for (float& radius : points.radii) radius = static_cast<float>(radius * factor);
    for (float& noise : points.noise) noise = static_cast<float>(noise * factor);
    points.scale_exponent += exponent;
}

} // namespace

const Vec3f* Points::sensorOf(std::size_t point) const {
    if (sensor_of_point.empty() || sensor_of_point[point] >= sensors.size()) return nullptr;
    return &sensors[sensor_of_point[point]];
}

Points takePoints(Cloud&& cloud) {
    std::vector<std::array<std::uint32_t, 3>>().swap(cloud.triangles);
    const Bounds bounds = boundsOf(cloud.positions);
    Points points;
    points.input_index = distinctIndices(cloud.positions, bounds);
    points.positions = gatherAndFree(cloud.positions, points.input_index);
    points.normals = gatherAndFree(cloud.normals, points.input_index);
    points.colors = gatherAndFree(cloud.colors, points.input_index);
    points.sensor_of_point = gatherAndFree(cloud.sensor_of_point, points.input_index);
    points.sensors = std::move(cloud.sensors);
    points.radii = gatherAndFree(cloud.radii, points.input_index);
    points.noise = gatherAndFree(cloud.noise, points.input_index);
    points.up = cloud.world.up.cast<float>();
    points.from_above = cloud.world.from_above;
    toUnitSize(points, bounds.longestEdge());
    forAll(points.normals, [](Vec3f& normal) { normal = unitOrZero(normal); });
    return points;
}

void keepPoints(Points& points, const std::vector<std::uint8_t>& keep) {
    keepFlagged(points.positions, keep);
    keepFlagged(points.normals, keep);
    keepFlagged(points.colors, keep);
    keepFlagged(points.sensor_of_point, keep);
    keepFlagged(points.radii, keep);
    keepFlagged(points.noise, keep);
    keepFlagged(points.input_index, keep);
}

bool refit(Points& points) {
    // Down to there 15 of the 21 bits an axis of the curve's code still tell points apart.
    constexpr double kSmall = 1.0 / 64;
    const Bounds bounds = boundsOf(points.positions);
    const double extent = bounds.longestEdge();
    if (extent >= kSmall || extent == 0) return false;
    const std::vector<std::uint32_t> order = distinctIndices(points.positions, bounds);
    points.positions = gatherAndFree(points.positions, order);
    points.normals = gatherAndFree(points.normals, order);
    points.colors = gatherAndFree(points.colors, order);
    points.sensor_of_point = gatherAndFree(points.sensor_of_point, order);
    points.radii = gatherAndFree(points.radii, order);
    points.noise = gatherAndFree(points.noise, order);
    points.input_index = gatherAndFree(points.input_index, order);
    toUnitSize(points, extent);
    return true;
}

} // namespace pointrt::surface

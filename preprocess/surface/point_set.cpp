// SPDX-License-Identifier: GPL-3.0-or-later
#include "preprocess/surface/point_set.h"

#include <cmath>
#include <numeric>
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

/// Frees the source, so that no two columns exist twice at a time.
template <typename T>
std::vector<T> gatherAndFree(std::vector<T>& source, const std::vector<std::uint32_t>& rows) {
    std::vector<T> gathered;
    if (source.empty()) return gathered;
    gathered.resize(rows.size());
    tbb::parallel_for(std::size_t(0), rows.size(), [&](std::size_t i) { gathered[i] = source[rows[i]]; });
    std::vector<T>().swap(source);
    return gathered;
}

template <typename Body>
void forColumns(PointSet& points, const Body& body) {
    std::apply([&](auto&... column) { (body(column), ...); }, points.columns());
}

template <typename T, typename Body>
void forAll(std::vector<T>& values, const Body& body) {
    tbb::parallel_for(std::size_t(0), values.size(), [&](std::size_t i) { body(values[i]); });
}

Vec3f scaled(const Vec3f& vector, double factor) { return (vector.cast<double>() * factor).cast<float>(); }

/// Unit length, or zero if the length is 0 or not finite.
Vec3f unitOrZero(const Vec3f& normal) {
    const Vec3d wide = normal.cast<double>();
    const double length = wide.norm();
    if (!std::isfinite(length) || length == 0) return Vec3f::Zero();
    return (wide / length).cast<float>();
}

/// Scales all lengths of points of this extent by a power of two: exact.
void toUnitSize(PointSet& points, double extent) {
    int exponent;
    std::frexp(extent, &exponent);
    const double factor = std::ldexp(1.0, -exponent);
    forAll(points.positions, [&](Vec3f& position) { position = scaled(position, factor); });
    for (Vec3f& sensor : points.sensors) sensor = scaled(sensor, factor);
    for (float& radius : points.given_radii) radius = static_cast<float>(radius * factor);
    for (float& noise : points.given_noise) noise = static_cast<float>(noise * factor);
    points.scale_exponent += exponent;
}

PointSet moveColumns(Cloud& cloud) {
    PointSet points;
    points.positions = std::move(cloud.positions);
    points.normals = std::move(cloud.normals);
    points.colors = std::move(cloud.colors);
    points.sensor_of_point = std::move(cloud.sensor_of_point);
    points.given_radii = std::move(cloud.radii);
    points.given_noise = std::move(cloud.noise);
    return points;
}

/// Drops the points of these indices, ascending. Fills input_index if there are any.
void dropRows(PointSet& points, const std::vector<std::uint32_t>& dropped) {
    if (dropped.empty()) return;
    points.input_index.resize(points.size());
    std::iota(points.input_index.begin(), points.input_index.end(), 0u);
    std::vector<std::uint8_t> keep(points.size(), 1);
    for (const std::uint32_t row : dropped) keep[row] = 0;
    keepRows(points, keep);
}

} // namespace

const Vec3f* PointSet::sensorOf(std::size_t point) const {
    if (sensor_of_point.empty() || sensor_of_point[point] >= sensors.size()) return nullptr;
    return &sensors[sensor_of_point[point]];
}

void keepRows(PointSet& points, const std::vector<std::uint8_t>& keep) {
    forColumns(points, [&](auto& column) { keepFlagged(column, keep); });
}

void appendRows(PointSet& points, const std::vector<std::uint32_t>& rows) {
    forColumns(points, [&](auto& column) {
        if (column.empty()) return;
        column.reserve(column.size() + rows.size());
        for (const std::uint32_t row : rows) column.push_back(column[row]);
    });
}

void selectRows(PointSet& points, const std::vector<std::uint32_t>& rows) {
    forColumns(points, [&](auto& column) { column = gatherAndFree(column, rows); });
}

PointSet takePoints(Cloud&& cloud, const std::vector<std::uint32_t>& left_out) {
    std::vector<std::array<std::uint32_t, 3>>().swap(cloud.triangles);
    PointSet points = moveColumns(cloud);
    dropRows(points, left_out);
    const Bounds bounds = boundsOf(points.positions);
    std::vector<std::uint32_t> order = distinctIndices(points.positions, bounds);
    selectRows(points, order);
    if (points.input_index.empty()) points.input_index = std::move(order);
    points.sensors = std::move(cloud.sensors);
    points.up = cloud.world.up.cast<float>();
    points.from_above = cloud.world.from_above;
    toUnitSize(points, bounds.longestEdge());
    forAll(points.normals, [](Vec3f& normal) { normal = unitOrZero(normal); });
    return points;
}

bool refit(PointSet& points) {
    // At this extent, 15 of the 21 bits per axis of the curve's code still distinguish points.
    constexpr double kSmall = 1.0 / 64;
    const Bounds bounds = boundsOf(points.positions);
    const double extent = bounds.longestEdge();
    if (extent >= kSmall || extent == 0) return false;
    selectRows(points, distinctIndices(points.positions, bounds));
    toUnitSize(points, extent);
    return true;
}

} // namespace pointrt::surface

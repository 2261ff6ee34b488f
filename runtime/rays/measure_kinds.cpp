// SPDX-License-Identifier: Apache-2.0
#include "runtime/rays/measure_kinds.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "format/base/error.h"
#include "runtime/util/vec_array.h"

namespace pointrt {
namespace {

/// Throws unless there are exactly count points.
void checkCount(const std::vector<Position>& points, std::size_t count, const std::string& what) {
    if (points.size() != count)
        throw Error(ExitCode::kBadUsage, "--points: " + what + " takes " + std::to_string(count) + " points, not " +
                                             std::to_string(points.size()));
}

Measured measuredLeg(MeasureKind kind, const std::vector<Position>& points, const Position& up) {
    checkCount(points, 2, kind == MeasureKind::kHeight ? "a height" : "a distance");
    const PathMeasures path = measurePath(points, up);
    std::vector<ResultNumber> numbers{
        {"height", path.height},    {"horizontal", path.horizontal}, {"slope", path.slope_deg, Quantity::kAngle},
        {"dx", path.difference[0]}, {"dy", path.difference[1]},      {"dz", path.difference[2]}};
    if (kind == MeasureKind::kDistance) numbers.insert(numbers.begin(), {"distance", path.last_leg});
    return {numbers, points, {}, GeoKind::kLineString};
}

Measured measuredAngle(const std::vector<Position>& points, const Position& up) {
    checkCount(points, 3, "an angle");
    const PathMeasures path = measurePath(points, up);
    return {{{"angle", *path.angle_deg, Quantity::kAngle},
             {"first_leg", path.length - path.last_leg},
             {"second_leg", path.last_leg}},
            points,
            {},
            GeoKind::kLineString};
}

Measured measuredPolyline(const std::vector<Position>& points, const Position& up) {
    const PathMeasures path = measurePath(points, up);
    const double rise = dot(vectorOf(points.back()) - vectorOf(points.front()), vectorOf(up));
    return {{{"length", path.length}, {"horizontal_length", path.horizontal_length}, {"height", rise}},
            points,
            {},
            GeoKind::kLineString};
}

Measured measuredArea(const std::vector<Position>& points, const Position& up) {
    const FittedPlane plane = fitPlane(points);
    const PathMeasures path = measurePath(points, up);
    const double slope_deg =
        std::acos(std::min(1.0, std::abs(dot(vectorOf(plane.normal), vectorOf(up))))) * 180 / std::numbers::pi;
    return {{{"area", *path.area, Quantity::kArea},
             {"plan_area", *path.plan_area, Quantity::kArea},
             {"perimeter", *path.perimeter},
             {"slope", slope_deg, Quantity::kAngle},
             {"flatness_rms", plane.rms}},
            points,
            {},
            GeoKind::kPolygon};
}

std::vector<ResultNumber> roundNumbers(double radius, const Position& center, double rms) {
    return {{"radius", radius},      {"diameter", 2 * radius}, {"center_x", center[0]},
            {"center_y", center[1]}, {"center_z", center[2]},  {"rms", rms}};
}

/// The circle as a polygon with steps of 1 degree, which is within 4e-5 of the radius.
std::vector<Position> circleOutline(const FittedCircle& circle) {
    constexpr int kSteps = 360;
    const Vec3 normal = vectorOf(circle.normal);
    const Vec3 aside = normalize(cross(normal, std::abs(normal.z) < 0.9 ? Vec3{0, 0, 1} : Vec3{1, 0, 0}));
    const Vec3 across = cross(normal, aside);
    std::vector<Position> outline;
    for (int step = 0; step < kSteps; ++step) {
        const double angle = 2 * std::numbers::pi * step / kSteps;
        outline.push_back(
            arrayOf(vectorOf(circle.center) + circle.radius * (std::cos(angle) * aside + std::sin(angle) * across)));
    }
    return outline;
}

Measured measuredCircle(const std::vector<Position>& points) {
    const FittedCircle circle = fitCircle(points);
    std::vector<ResultNumber> numbers = roundNumbers(circle.radius, circle.center, circle.rms);
    numbers.push_back({"circumference", 2 * std::numbers::pi * circle.radius});
    return {numbers, points, circleOutline(circle), GeoKind::kPolygon};
}

Measured measuredSphere(const std::vector<Position>& points) {
    const FittedSphere sphere = fitSphere(points);
    return {roundNumbers(sphere.radius, sphere.center, sphere.rms), points, {sphere.center}, GeoKind::kPoint};
}

const std::vector<Position>& drawnOf(const Measured& measured) {
    return measured.outline.empty() ? measured.points : measured.outline;
}

} // namespace

Measured measurePoints(MeasureKind kind, const std::vector<Position>& points, const Position& up) {
    switch (kind) {
    case MeasureKind::kDistance:
    case MeasureKind::kHeight:
        return measuredLeg(kind, points, up);
    case MeasureKind::kAngle:
        return measuredAngle(points, up);
    case MeasureKind::kArea:
        return measuredArea(points, up);
    case MeasureKind::kCircle:
        return measuredCircle(points);
    case MeasureKind::kSphere:
        return measuredSphere(points);
    case MeasureKind::kPolyline:
    case MeasureKind::kVolume:
        break;
    }
    return measuredPolyline(points, up);
}

Measured measuredVolume(const Volume& volume, const std::vector<Position>& rim) {
    const double share = std::min(1.0, volume.covered / volume.area); // rounding may make it more than 1
    return {{{"cut", volume.cut, Quantity::kVolume},
             {"fill", volume.fill, Quantity::kVolume},
             {"net", volume.net(), Quantity::kVolume},
             {"plan_area", volume.area, Quantity::kArea},
             {"covered", share, Quantity::kShare},
             {"cell", volume.cell},
             {"rim_rms", volume.base.rms}},
            rim,
            {},
            GeoKind::kPolygon};
}

std::string measuredGeoJson(const Measured& measured, const SceneUnits& units) {
    GeoFeature feature{measured.drawn, drawnOf(measured), {}};
    for (const ResultNumber& number : measured.numbers) feature.properties.emplace_back(number.name, number.value);
    return geoJsonText({feature}, units.decimals, units.epsg);
}

std::string measuredDxf(const Measured& measured, MeasureKind kind, const SceneUnits& units) {
    constexpr DxfEntity::Kind kDrawn[] = {DxfEntity::Kind::kPoints, DxfEntity::Kind::kPolyline,
                                          DxfEntity::Kind::kPolygon};
    const std::string layer = nameOf(kMeasureKindNames, kind);
    std::vector<DxfEntity> entities{{kDrawn[static_cast<int>(measured.drawn)], layer, drawnOf(measured)}};
    if (!measured.outline.empty()) entities.push_back({DxfEntity::Kind::kPoints, "points", measured.points});
    return dxfText(entities, units.decimals);
}

} // namespace pointrt

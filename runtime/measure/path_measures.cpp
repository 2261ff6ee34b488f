// SPDX-License-Identifier: Apache-2.0
#include <cmath>
#include <numbers>

#include "pointrt/measure.hpp"
#include "runtime/measure/given_points.h"
#include "runtime/util/vec_array.h"

namespace pointrt {
namespace {

double degreesOf(double radians) { return radians * 180 / std::numbers::pi; }

double angleBetween(Vec3 a, Vec3 b) {
    return degreesOf(std::atan2(length(cross(a, b)), dot(a, b))); // exact for small angles, too
}

/// Half the sum of cross products (Newell), relative to the first point because national coordinates have seven digits.
Vec3 vectorArea(std::span<const Vec3> points) {
    Vec3 sum;
    for (std::size_t i = 2; i < points.size(); ++i) sum = sum + cross(points[i - 1] - points[0], points[i] - points[0]);
    return 0.5 * sum;
}

void measurePolygon(std::span<const Vec3> points, Vec3 up, PathMeasures& measures) {
    const Vec3 last_leg = vectorOf(measures.difference);
    measures.angle_deg = angleBetween(points[points.size() - 3] - points[points.size() - 2], last_leg);
    const Vec3 area = vectorArea(points);
    measures.area = length(area);
    measures.plan_area = std::abs(dot(area, up));
    measures.perimeter = measures.length + length(points.front() - points.back());
}

} // namespace

PathMeasures measurePath(std::span<const Position> given, const Position& upwards) {
    requireCount(given, 2, "a path");
    std::vector<Vec3> points;
    for (const Position& point : given) points.push_back(vectorOf(point));
    const Vec3 up = vectorOf(upwards);
    PathMeasures measures;
    for (std::size_t i = 1; i < points.size(); ++i) {
        const Vec3 leg = points[i] - points[i - 1];
        measures.length += length(leg);
        measures.height = dot(leg, up);
        measures.horizontal = length(leg - measures.height * up);
        measures.horizontal_length += measures.horizontal;
    }
    const Vec3 last = points.back() - points[points.size() - 2];
    measures.difference = arrayOf(last);
    measures.last_leg = length(last);
    measures.slope_deg = degreesOf(std::atan2(measures.height, measures.horizontal));
    if (points.size() > 2) measurePolygon(points, up, measures);
    return measures;
}

} // namespace pointrt

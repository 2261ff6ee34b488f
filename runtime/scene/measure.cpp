// SPDX-License-Identifier: Apache-2.0
#include "runtime/scene/measure.h"

#include <algorithm>
#include <cmath>

#include "pointrt/measure.hpp"
#include "runtime/measure/decimal_text.h"
#include "runtime/util/vec_array.h"

namespace pointrt {
namespace {

/// Twice the step to which a scan's positions are rounded, 2^-21 of its octree's edge.
constexpr double kResolved = 1e-6;
/// Beyond this limit of coordinates in scene files, a length would be a long row of digits.
constexpr double kMostWritten = 1e12;

PathMeasures measuresOf(const MeasureDescription& measure) {
    std::vector<Position> points;
    for (const Vec3 point : measure.points) points.push_back(arrayOf(point));
    return measurePath(points, {0, 0, 1}); // neither length nor area depends on up
}

std::string numberText(double value, double step) {
    return decimalText(std::min(value, kMostWritten * kMostWritten), decimalsOf(step));
}

} // namespace

std::string measuredText(const MeasureDescription& measure, const MeasureUnits& units) {
    const PathMeasures measures = measuresOf(measure);
    const std::string unit = units.unit.empty() ? "" : " " + units.unit;
    const double step = kResolved * units.scene_size;
    if (!measure.closed) return numberText(measures.length, step) + unit;
    // the resolution of an area: its change when a side, a hundredth of the scene long, moves by one step
    const std::string area = numberText(measures.area.value_or(0), 1e-2 * units.scene_size * step);
    return area + (unit.empty() ? "" : unit + "2");
}

std::string labelOf(const MeasureDescription& measure, const MeasureUnits& units) {
    const std::string& name = measure.layer.name;
    // the number first, so that cutting the text hides no digits
    return measuredText(measure, units) + (name.empty() ? "" : ", " + name);
}

Vec3 labelPlace(const MeasureDescription& measure) {
    const std::vector<Vec3>& points = measure.points;
    if (measure.closed) {
        Vec3 sum;
        for (const Vec3 point : points) sum = sum + point;
        return sum * (1 / static_cast<double>(points.size()));
    }
    double left = measuresOf(measure).length / 2;
    for (std::size_t i = 1; i < points.size(); ++i) {
        const double leg = length(points[i] - points[i - 1]);
        if (left < leg) return points[i - 1] + (points[i] - points[i - 1]) * (left / leg);
        left -= leg;
    }
    return points.back();
}

} // namespace pointrt

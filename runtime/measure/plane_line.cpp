// SPDX-License-Identifier: Apache-2.0
#include "runtime/measure/plane_line.h"

#include <algorithm>
#include <cmath>

namespace pointrt {

double lengthOf(const PlaneLine& line) {
    double sum = 0;
    for (std::size_t i = 1; i < line.points.size(); ++i) sum += length(line.points[i] - line.points[i - 1]);
    return sum + (line.closed ? length(line.points.front() - line.points.back()) : 0);
}

StraightLine fitStraight(std::span<const Vec2> points) {
    Vec2 center;
    for (const Vec2 point : points) center = center + point;
    center = (1 / static_cast<double>(points.size())) * center;
    double xx = 0, xy = 0, yy = 0;
    for (const Vec2 point : points) {
        const Vec2 d = point - center;
        xx += d.x * d.x;
        xy += d.x * d.y;
        yy += d.y * d.y;
    }
    const double angle = std::atan2(2 * xy, xx - yy) / 2; // angle of the principal axis with the larger spread
    return {center, {std::cos(angle), std::sin(angle)}};
}

std::optional<Vec2> crossingOf(const StraightLine& a, const StraightLine& b) {
    // sin(6 degrees): at this angle, an error of a line moves the crossing ten times as far
    constexpr double kParallel = 0.1;
    const double sine = cross(a.direction, b.direction);
    if (std::abs(sine) < kParallel) return {};
    return a.center + (cross(b.center - a.center, b.direction) / sine) * a.direction;
}

double distanceToSegment(Vec2 point, Vec2 from, Vec2 to) {
    const Vec2 d = to - from;
    const double square = dot(d, d);
    const double share = square > 0 ? std::clamp(dot(point - from, d) / square, 0.0, 1.0) : 0;
    return length(point - from - share * d);
}

} // namespace pointrt

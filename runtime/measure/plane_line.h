// SPDX-License-Identifier: Apache-2.0
// Lines in a plane, and their best straight fit.
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "runtime/util/vec2.h"

namespace pointrt {

struct PlaneLine {
    std::vector<Vec2> points;
    bool closed = false; ///< the last point is followed by the first
};

double lengthOf(const PlaneLine& line);

/// An infinite straight line.
struct StraightLine {
    Vec2 center, direction; ///< unit length
    Vec2 nearestTo(Vec2 point) const { return center + dot(point - center, direction) * direction; }
};

/// The line with the least sum of squared distances. points: at least one; if all coincide, the direction is x.
StraightLine fitStraight(std::span<const Vec2> points);

/// The crossing of two lines. None if they are parallel within 6 degrees, since the crossing is then ill-conditioned.
std::optional<Vec2> crossingOf(const StraightLine& a, const StraightLine& b);

/// The distance of a point from the segment between two others.
double distanceToSegment(Vec2 point, Vec2 from, Vec2 to);

} // namespace pointrt

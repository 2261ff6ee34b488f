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

/// A straight line without ends.
struct StraightLine {
    Vec2 center, direction; ///< unit length
    Vec2 nearestTo(Vec2 point) const { return center + dot(point - center, direction) * direction; }
};

/// The least-squares fit of distances. points: at least one; the direction of equal points is x.
StraightLine fitStraight(std::span<const Vec2> points);

/// The crossing of two lines. None if they are parallel within 6 degrees, as the crossing is then ill conditioned.
std::optional<Vec2> crossingOf(const StraightLine& a, const StraightLine& b);

/// The distance of a point from the segment between two others.
double distanceToSegment(Vec2 point, Vec2 from, Vec2 to);

} // namespace pointrt

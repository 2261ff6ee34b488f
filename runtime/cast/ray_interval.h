// SPDX-License-Identifier: Apache-2.0
// Ray-box intersection by the slab method.
#pragma once

#include <algorithm>
#include <limits>

#include "runtime/util/vec.h"

namespace pointrt {

/// The distance of a miss, and the end of an unbounded interval.
constexpr double kInfinity = std::numeric_limits<double>::infinity();

/// An interval along a ray, in lengths of its direction.
struct RayInterval {
    double from = 0, to = 0;
    bool isEmpty() const { return !(from <= to); }
};

/// Clips the interval to the slab between two planes. For a ray parallel to the planes, that is all or nothing. If the
/// ray lies in one of them, 0 * inf is NaN, which min and max ignore with their arguments in this order.
inline void clipToSlab(RayInterval& interval, double origin, double inverse, double low, double high) {
    const double a = (low - origin) * inverse, b = (high - origin) * inverse;
    interval.from = std::max(interval.from, std::min(a, b));
    interval.to = std::min(interval.to, std::max(a, b));
}

/// The part of the interval inside a box.
/// @param inverse reciprocal of the direction, per component
inline RayInterval clipToBox(RayInterval interval, Vec3 origin, Vec3 inverse, Vec3 low, Vec3 high) {
    clipToSlab(interval, origin.x, inverse.x, low.x, high.x);
    clipToSlab(interval, origin.y, inverse.y, low.y, high.y);
    clipToSlab(interval, origin.z, inverse.z, low.z, high.z);
    return interval;
}

} // namespace pointrt

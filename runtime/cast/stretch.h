// SPDX-License-Identifier: Apache-2.0
// What of a ray is in a box.
#pragma once

#include <algorithm>

#include "runtime/util/vec.h"

namespace pointrt {

/// A stretch of a ray, in lengths of its direction.
struct Stretch {
    double from = 0, to = 0;
    bool isEmpty() const { return !(from <= to); }
};

/// What of the stretch is between two planes. Where the ray runs along them it is all or nothing; in one of them 0 *
/// inf is no number, and min and max, with their arguments in this order, pass it over.
inline void cut(Stretch& stretch, double origin, double inverse, double low, double high) {
    const double a = (low - origin) * inverse, b = (high - origin) * inverse;
    stretch.from = std::max(stretch.from, std::min(a, b));
    stretch.to = std::min(stretch.to, std::max(a, b));
}

/// What of the stretch is in the box; inverse: one over the direction, by component.
inline Stretch within(Stretch stretch, Vec3 origin, Vec3 inverse, Vec3 low, Vec3 high) {
    cut(stretch, origin.x, inverse.x, low.x, high.x);
    cut(stretch, origin.y, inverse.y, low.y, high.y);
    cut(stretch, origin.z, inverse.z, low.z, high.z);
    return stretch;
}

} // namespace pointrt

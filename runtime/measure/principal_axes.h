// SPDX-License-Identifier: Apache-2.0
// The principal axes of points.
#pragma once

#include <array>
#include <span>

#include "runtime/util/vec.h"

namespace pointrt {

struct PrincipalAxes {
    Vec3 center;                     ///< centroid
    std::array<Vec3, 3> axes;        ///< orthonormal, the direction of the largest spread first
    std::array<double, 3> deviation; ///< root mean square of the points' coordinates along each axis, descending
};

/// points: at least one.
PrincipalAxes principalAxes(std::span<const Vec3> points);

} // namespace pointrt

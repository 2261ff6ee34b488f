// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cmath>
#include <numbers>

#include "preprocess/cloud/cloud.h"

namespace pointrt::quality {

/// Angle between two vectors of any length, 0 to 180 degrees; exact for small ones, unlike the arc cosine.
inline double degreesBetween(const Vec3d& a, const Vec3d& b) {
    return std::atan2(a.cross(b).norm(), a.dot(b)) * 180 / std::numbers::pi;
}

/// The same for directions without a sign, 0 to 90 degrees.
inline double degreesBetweenLines(const Vec3d& a, const Vec3d& b) {
    return std::atan2(a.cross(b).norm(), std::abs(a.dot(b))) * 180 / std::numbers::pi;
}

} // namespace pointrt::quality

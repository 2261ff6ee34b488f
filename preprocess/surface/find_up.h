// SPDX-License-Identifier: GPL-3.0-or-later
// Finds which direction is up if no file says so.
#pragma once

#include <string>
#include <vector>

#include "preprocess/cloud/splats.h"

namespace pointrt {

struct FoundUp {
    Vec3d up = Vec3d::Zero(); ///< unit length; zero: unknown
    std::string reason;       ///< the evidence, in a few words; "" if unknown
};

/// Infers up from the surface and the scanner positions; unknown if they say little: a sphere, a box, a relief. Rules,
/// in this order:
///   - camera frame: one sensor on the z axis, with all points in a cone along it; -y is up;
///   - scanner positions: four or more stations in a plane; up is its normal;
///   - ground: level wherever it is seen from below, but not from above, or higher there;
///   - room: level at the bottom and at the top, with shelves in between;
///   - level surfaces: most of the surface is level and the rest are walls if z is up, as scanners have it;
///   - map coordinates: x and y far from zero, z not;
///   - terrain: wide, flat, and level on both sides if z is up;
///   - base: the only side on which the object stands without falling over;
///   - vertical pole: along z.
/// Directions within 5 degrees of an axis become that axis. The result does not depend on the number of threads.
FoundUp findUp(const Splats& splats, const std::vector<Scan>& scans);

} // namespace pointrt

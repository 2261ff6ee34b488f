// SPDX-License-Identifier: GPL-3.0-or-later
// Which way is up, where no file says it.
#pragma once

#include <string>
#include <vector>

#include "preprocess/cloud/splats.h"

namespace pointrt {

struct FoundUp {
    Vec3d up = Vec3d::Zero(); ///< unit length; zero: not known
    std::string reason;       ///< what tells it, in a few words; "" where nothing does
};

/// What the surface and where it was scanned from tell of up; not known where they tell little: a sphere, a box, a
/// relief. In this order:
///   - one sensor on the z axis that sees all within a cone along it is a camera's own frame: its y goes down;
///   - four and more stations that stand in a plane: up is across it;
///   - ground: wherever one looks from below it is level, and from above it is not, or higher;
///   - a room: level at the bottom and at the top, with shelves between;
///   - most of the surface is level, and the rest are walls, if z is up: scanners put z there;
///   - coordinates as on a map: x and y far away from zero, z not;
///   - terrain: wide, flat, and level on both sides, if z is up;
///   - a base: the one side on which it stands without falling over;
///   - a pole along z.
/// Directions are the axes, where they are within 5 degrees. Same for any number of threads.
FoundUp findUp(const Splats& splats, const std::vector<Scan>& scans);

} // namespace pointrt

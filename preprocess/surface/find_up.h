// SPDX-License-Identifier: GPL-3.0-or-later
// Finds which direction is up if no file says so.
#pragma once

#include <string>
#include <vector>

#include "preprocess/cloud/splats.h"

namespace pointrt {

/// What is known about up before looking at the surface.
struct UpPrior {
    Vec3d custom = Vec3d::Zero(); ///< the format's convention, unit length; zero: it has none
    bool is_mesh = false;         ///< every scan has faces
};

/// What an up direction is based on.
enum class UpBasis { kData, kCustom, kGuess };

/// "data", "format" or "guess", as reports name it.
const char* nameOf(UpBasis basis);

struct FoundUp {
    Vec3d up = Vec3d::Zero(); ///< unit length; zero: there are no splats
    UpBasis basis = UpBasis::kGuess;
    std::string reason; ///< the evidence, or the usual convention, in a few words
};

/// Infers up from the surface and the scanner positions. Rules, in this order:
///   - camera frame: one sensor on the z axis, with all points in a cone along it; -y is up;
///   - scanner positions: four or more stations in a plane; up is its normal;
///   - ground: the lowest surface is level, and the highest is less so or less even in height;
///   - room: level at the bottom and at the top, with shelves in between;
///   - level surfaces: most of the surface is level and the rest are walls if z is up, as scanners have it;
///   - map coordinates: x and y far from zero, z not;
///   - terrain: wide, flat, and level on both sides if z is up;
///   - storeys: floors, ceilings and walls of a building if y is up;
///   - base: the only side on which the object stands without falling over, unless that is the side of x or -z;
///   - vertical pole: along z.
/// If none of them decides, as for a sphere, a box or a relief, up is the format's convention or, without one, a guess:
/// z for points, but y for fronts that face along z; y for meshes, but z for those that lie flat as terrain does. For
/// formats with a convention, map coordinates are checked first: they confirm it. Directions within 5 degrees of an
/// axis become that axis. The result does not depend on the number of threads.
FoundUp findUp(const Splats& splats, const std::vector<Scan>& scans, const UpPrior& prior = {});

} // namespace pointrt

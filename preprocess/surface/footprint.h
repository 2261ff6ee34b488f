// SPDX-License-Identifier: GPL-3.0-or-later
// What a surface would stand on if one direction were up.
#pragma once

#include "preprocess/surface/surface_sample.h"

namespace pointrt::upright {

/// All are shares, 0 to 1.
struct Footprint {
    double level = 0;   ///< of the ground plan: its lowest surface is level there
    double floor = 0;   ///< ... and at the height of the lowest of all
    double height = 0;  ///< of the whole over the longer edge of its ground plan; above 1 where it is a tower
    double shelves = 0; ///< of the level area: neither at the lowest nor at the highest
    double middle = 0;  ///< height below which half of the surface lies
};

Footprint footprintOf(const SurfaceSample& sample, const Vec3d& up);

/// How well it stands if nothing else holds it: the convex hull of what touches the ground over that of the whole, seen
/// from above; 0 where the centroid is not above it.
double supportOf(const SurfaceSample& sample, const Vec3d& up);

} // namespace pointrt::upright

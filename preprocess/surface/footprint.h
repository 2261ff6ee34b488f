// SPDX-License-Identifier: GPL-3.0-or-later
// Measures of a surface if a given direction were up.
#pragma once

#include "preprocess/surface/surface_sample.h"

namespace pointrt::upright {

/// All are shares from 0 to 1, except height.
struct Footprint {
    double level = 0;   ///< share of the ground plan where its lowest surface is level
    double floor = 0;   ///< ... and at the height of the lowest point
    double height = 0;  ///< total height over the longer edge of the ground plan; above 1 for a tower
    double shelves = 0; ///< share of the level area neither near the bottom nor near the top
    double middle = 0;  ///< median height of the surface over the total height
};

Footprint footprintOf(const SurfaceSample& sample, const Vec3d& up);

/// Stability: area of the convex hull of the contact with the ground over that of the whole, seen from above; 0 if the
/// centroid is not above it.
double supportOf(const SurfaceSample& sample, const Vec3d& up);

} // namespace pointrt::upright

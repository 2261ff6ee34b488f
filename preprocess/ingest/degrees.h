// SPDX-License-Identifier: GPL-3.0-or-later
// Clouds with degrees of longitude and latitude but heights in metres.
#pragma once

#include "preprocess/cloud/cloud.h"

namespace pointrt {

/// Lengths in metres of a degree of longitude and of latitude on the WGS 84 ellipsoid, from the radii of curvature
/// of the parallel and of the meridian (J. P. Snyder, Map Projections: A Working Manual, USGS 1987, equations 4-18 to
/// 4-21).
/// @param latitude degrees, within 90 of the equator
Eigen::Vector2d metresPerDegree(double latitude);

/// Converts degrees of longitude and latitude to metres east (x) and north (y) of the middle of all points. The scale
/// is exact there; a kilometre north of it x is off by 0.016% times the tangent of the latitude. Within a degree of the
/// cloud's origin, positions are off by up to 3 mm, since they were floats in degrees. Leaves z, attributes, normals
/// and radii unchanged. The cloud loses its named coordinate system; a note for the file says how to keep degrees.
/// Returns false, with a note and nothing changed, if the coordinates cannot be degrees.
bool scaleDegrees(Cloud& cloud, const std::string& file);

} // namespace pointrt

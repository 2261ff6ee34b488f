// SPDX-License-Identifier: GPL-3.0-or-later
// Clouds in degrees of longitude and latitude beside metres of height.
#pragma once

#include "preprocess/cloud/cloud.h"

namespace pointrt {

/// Metres that a degree of longitude and one of latitude are long, on the ellipsoid of WGS 84: the radii of curvature
/// of the parallel and of the meridian (J. P. Snyder, Map Projections: A Working Manual, USGS 1987, equations 4-18 to
/// 4-21).
/// @param latitude degrees, within 90 of the equator
Eigen::Vector2d metresPerDegree(double latitude);

/// Metres in x to the east and in y to the north of the middle of all points, which are in degrees of longitude and
/// latitude: true to scale there; a kilometre north of it x is off by 0.016% times the tangent of the latitude.
/// Positions are off by up to 3 mm within a degree of the cloud's origin, as they are floats of degrees before. z
/// stays, and so do attributes, normals and radii. The cloud is in no named coordinate system any more, and a note in
/// the name of file says how to go back. Returns false, and changes nothing but for a note, where the coordinates
/// cannot be degrees.
bool scaleDegrees(Cloud& cloud, const std::string& file);

} // namespace pointrt

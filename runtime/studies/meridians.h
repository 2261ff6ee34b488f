// SPDX-License-Identifier: Apache-2.0
// How the meridians run on the maps that coordinate systems make. After Snyder, Map Projections: a working manual (USGS
// Professional Paper 1395, 1987), on the sphere: within a zone of 6 degrees that is a thousandth of a degree off.
#pragma once

#include <optional>
#include <string_view>

namespace pointrt {

/// On all of these maps the central meridian is a straight line along grid north.
struct Meridians {
    bool transverse = false; ///< transverse Mercator; else all of them are straight lines
    double central_deg = 0;  ///< longitude
    double cone = 0;         ///< angle between two straight ones, of their difference in longitude
};

/// Of a system in WKT, version 1 or 2, or "EPSG:N" of a UTM zone and a few national grids. None where it is no map, or
/// one whose meridians are not known here, or has angles that are not degrees from Greenwich.
std::optional<Meridians> meridiansOf(std::string_view crs);

/// Degrees that grid north lies clockwise of true north.
double convergenceDeg(const Meridians& meridians, double latitude_deg, double longitude_deg);

/// How far a longitude lies east of another one, from -180 to 180.
double degreesEast(double longitude_deg, double of_deg);

} // namespace pointrt

// SPDX-License-Identifier: Apache-2.0
// Projected coordinate systems, as PROJ and its database define them.
#pragma once

#include <optional>
#include <string>
#include <string_view>

namespace pointrt {

/// Bounds in degrees from Greenwich. West is greater than east where the area crosses the antimeridian.
struct AreaOfUse {
    double west_deg, south_deg, east_deg, north_deg;
};

struct ProjectedCrs {
    std::string name;           ///< such as "CH1903+ / LV95"
    double metres_per_unit = 1; ///< of easting and northing
    std::optional<AreaOfUse> area_of_use;
};

/// Whether PROJ (libproj.so.25) and its database are installed.
bool isProjInstalled();

/// Interprets "EPSG:N" or WKT, version 1 or 2; the projected part of a compound or bound system. nullopt if the text is
/// not a coordinate system, or not a projected one.
/// @throws Error kCannotRun if PROJ is not installed, or its database is missing
std::optional<ProjectedCrs> projectedCrs(std::string_view crs);

/// Meridian convergence: the angle from true north to grid north, clockwise, in degrees.
/// @param crs as for projectedCrs
/// @param longitude_deg from Greenwich
/// @return nullopt if projectedCrs would return nullopt, or if the projection is not defined there
/// @throws Error as projectedCrs does
std::optional<double> meridianConvergenceDeg(std::string_view crs, double latitude_deg, double longitude_deg);

struct GeographicPlace {
    double latitude_deg = 0, longitude_deg = 0; ///< north and east positive, from Greenwich
};

/// The WGS 84 position of a point in a projected system; accurate to some 100 m if datum shift grids are missing.
/// @param crs as for projectedCrs
/// @param easting, northing in the system's unit
/// @return nullopt if projectedCrs would return nullopt, or outside the projection
/// @throws Error as projectedCrs does
std::optional<GeographicPlace> geographicPlace(std::string_view crs, double easting, double northing);

} // namespace pointrt

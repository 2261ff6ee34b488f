// SPDX-License-Identifier: Apache-2.0
// Where the sun stands.
#pragma once

#include "runtime/util/vec.h"

namespace pointrt {

/// Of the sun's centre.
struct SunPosition {
    double elevation_deg; ///< over the horizon, -90 to 90
    double azimuth_deg;   ///< from north by way of east, 0 to 360
    bool operator==(const SunPosition&) const = default;
};

/// Without the bending of light in the air, by NOAA's Solar Calculator (https://gml.noaa.gov/grad/solcalc/), which is
/// Meeus, Astronomical Algorithms, 2nd edition, chapter 25 at low accuracy. Within 0.02 degrees from 1900 to 2100.
/// unix_seconds: UTC since 1970-01-01; latitude_deg -90 to 90, north above 0; longitude_deg -180 to 180, east above 0.
SunPosition sunPosition(double unix_seconds, double latitude_deg, double longitude_deg);

/// How much higher the sun looks through air of sea level, in degrees; the same source.
double refraction(double elevation_deg);

/// The horizontal direction taken for north where none is given: -Z, or +Y where Z is up. Unit length.
Vec3 defaultNorth(Vec3 up);

/// Unit vector towards the sun. up: unit length; north: any length, not along up; only its horizontal part counts.
Vec3 sunDirection(SunPosition sun, Vec3 up, Vec3 north);

} // namespace pointrt

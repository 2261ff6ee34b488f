// SPDX-License-Identifier: Apache-2.0
// The position of the sun.
#pragma once

#include "runtime/util/vec.h"

namespace pointrt {

/// The direction to the sun's centre.
struct SunPosition {
    double elevation_deg; ///< above the horizon, -90 to 90
    double azimuth_deg;   ///< clockwise from north, 0 to 360
    bool operator==(const SunPosition&) const = default;
};

/// The sun's position without atmospheric refraction, accurate to 0.02 degrees from 1900 to 2100. Source: NOAA Solar
/// Calculator (https://gml.noaa.gov/grad/solcalc/), after Meeus, Astronomical Algorithms, 2nd edition, chapter 25, low
/// accuracy. unix_seconds: UTC since 1970-01-01; latitude_deg: -90 to 90, north positive; longitude_deg: -180 to 180,
/// east positive.
SunPosition sunPosition(double unix_seconds, double latitude_deg, double longitude_deg);

/// Atmospheric refraction at sea level: how much higher the sun appears, in degrees; same source.
double refraction(double elevation_deg);

/// The default north: -Z, or +Y if Z is up, made horizontal. Unit length.
Vec3 defaultNorth(Vec3 up);

/// Unit vector to the sun. up: unit length; north: any length, not along up; only its horizontal part is used.
Vec3 sunDirection(SunPosition sun, Vec3 up, Vec3 north);

} // namespace pointrt

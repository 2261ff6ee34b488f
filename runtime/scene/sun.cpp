// SPDX-License-Identifier: Apache-2.0
#include "runtime/scene/sun.h"

#include <cmath>

#include "runtime/util/degree.h"

namespace pointrt {
namespace {

double sine(double deg) { return std::sin(deg * kDegree); }
double cosine(double deg) { return std::cos(deg * kDegree); }

// The numbers below are from the source; angles in degrees, t in Julian centuries since noon of 2000-01-01.

/// The sun's coordinates on a date.
struct Almanac {
    double declination_deg;
    double equation_of_time_min; ///< apparent minus mean solar time
};

double meanLongitude(double t) { return 280.46646 + t * (36000.76983 + t * 0.0003032); }
double meanAnomaly(double t) { return 357.52911 + t * (35999.05029 - t * 0.0001537); }
double eccentricity(double t) { return 0.016708634 - t * (0.000042037 + t * 0.0000001267); }
double moonNode(double t) { return 125.04 - 1934.136 * t; }

double apparentLongitude(double t) {
    const double m = meanAnomaly(t);
    const double center = sine(m) * (1.914602 - t * (0.004817 + t * 0.000014)) +
                          sine(2 * m) * (0.019993 - t * 0.000101) + sine(3 * m) * 0.000289;
    return meanLongitude(t) + center - 0.00569 - 0.00478 * sine(moonNode(t));
}

double obliquity(double t) {
    const double seconds = 21.448 - t * (46.815 + t * (0.00059 - t * 0.001813));
    return 23 + (26 + seconds / 60) / 60 + 0.00256 * cosine(moonNode(t));
}

Almanac almanac(double t) {
    const double tilt = obliquity(t), l = meanLongitude(t), m = meanAnomaly(t), e = eccentricity(t);
    const double y = std::pow(std::tan(tilt / 2 * kDegree), 2);
    const double radians = y * sine(2 * l) - 2 * e * sine(m) + 4 * e * y * sine(m) * cosine(2 * l) -
                           0.5 * y * y * sine(4 * l) - 1.25 * e * e * sine(2 * m);
    constexpr double minutes_per_degree = 4; // the Earth's rotation
    return {std::asin(sine(tilt) * sine(apparentLongitude(t))) / kDegree, minutes_per_degree * radians / kDegree};
}

} // namespace

SunPosition sunPosition(double unix_seconds, double latitude_deg, double longitude_deg) {
    constexpr double noon_of_2000 = 946728000, day = 86400;
    const Almanac today = almanac((unix_seconds - noon_of_2000) / (36525 * day));
    const double seconds_of_day = unix_seconds - day * std::floor(unix_seconds / day);
    const double hour_angle = seconds_of_day / 240 + today.equation_of_time_min / 4 + longitude_deg - 180;
    // the sun's direction by east, north and up
    const double d = today.declination_deg;
    const double east = -cosine(d) * sine(hour_angle);
    const double north = sine(d) * cosine(latitude_deg) - cosine(d) * sine(latitude_deg) * cosine(hour_angle);
    const double up = sine(d) * sine(latitude_deg) + cosine(d) * cosine(latitude_deg) * cosine(hour_angle);
    const double azimuth = std::atan2(east, north) / kDegree;
    return {std::atan2(up, std::hypot(east, north)) / kDegree, azimuth < 0 ? azimuth + 360 : azimuth};
}

double refraction(double elevation_deg) {
    const double h = elevation_deg, tangent = std::tan(h * kDegree);
    double seconds = 0;
    if (h > 85)
        seconds = 0;
    else if (h > 5)
        seconds = 58.1 / tangent - 0.07 / std::pow(tangent, 3) + 0.000086 / std::pow(tangent, 5);
    else if (h > -0.575)
        seconds = 1735 + h * (-518.2 + h * (103.4 + h * (-12.79 + h * 0.711)));
    else
        seconds = -20.774 / tangent;
    return seconds / 3600;
}

Vec3 defaultNorth(Vec3 up) {
    const Vec3 minus_z{0, 0, -1}, plus_y{0, 1, 0};
    // within 8 degrees of up, the horizontal part of -Z is too short
    const Vec3 north = std::abs(dot(minus_z, up)) > 0.99 ? plus_y : minus_z;
    return normalize(north - up * dot(north, up));
}

Vec3 sunDirection(SunPosition sun, Vec3 up, Vec3 north) {
    const Vec3 ahead = normalize(north - up * dot(north, up));
    const Vec3 east = cross(ahead, up);
    return up * sine(sun.elevation_deg) +
           (ahead * cosine(sun.azimuth_deg) + east * sine(sun.azimuth_deg)) * cosine(sun.elevation_deg);
}

} // namespace pointrt

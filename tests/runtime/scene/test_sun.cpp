// SPDX-License-Identifier: Apache-2.0
#include "runtime/scene/sun.h"

#include <gtest/gtest.h>

#include <chrono>

namespace pointrt {
namespace {

using namespace std::chrono;

double utc(int year_number, unsigned month_number, unsigned day_number, double hour, double minute = 0) {
    const sys_days date = year{year_number} / month{month_number} / day{day_number};
    return 86400.0 * static_cast<double>(date.time_since_epoch().count()) + 3600 * hour + 60 * minute;
}

void expectSun(SunPosition sun, double elevation_deg, double azimuth_deg, double within_deg) {
    EXPECT_NEAR(sun.elevation_deg, elevation_deg, within_deg);
    EXPECT_NEAR(sun.azimuth_deg, azimuth_deg, within_deg);
}

void expectVector(Vec3 v, double x, double y, double z) {
    EXPECT_NEAR(v.x, x, 1e-12);
    EXPECT_NEAR(v.y, y, 1e-12);
    EXPECT_NEAR(v.z, z, 1e-12);
}

// Meeus, Astronomical Algorithms, example 25.a: declination -7.78507 on 1992-10-13 at 0 h; at the pole it is the
// height.
TEST(Sun, AgreesWithMeeusAtThePole) {
    EXPECT_NEAR(sunPosition(utc(1992, 10, 13, 0), 90, 0).elevation_deg, -7.78507, 0.001);
}

// Reda and Andreas, Solar Position Algorithm, NREL/TP-560-34302, table A5.1: 12:30:30 at UTC-7; without refraction.
TEST(Sun, AgreesWithTheSolarPositionAlgorithm) {
    expectSun(sunPosition(utc(2003, 10, 17, 19, 30.5), 39.742476, -105.1786), 39.872046, 194.340241, 0.01);
}

// Computed with ERFA (the IAU's routines) by way of astropy 8.0.2, without refraction.
TEST(Sun, AgreesWithErfaAllOverTheWorld) {
    expectSun(sunPosition(utc(2024, 6, 21, 10), 52.52, 13.405), 58.1367, 149.321, 0.02);
    expectSun(sunPosition(utc(2024, 12, 21, 12), 51.4779, 0), 15.0804, 180.4061, 0.02);
    expectSun(sunPosition(utc(2026, 3, 20, 3), 35.6762, 139.6503), 54.0364, 184.7098, 0.02);
    expectSun(sunPosition(utc(2024, 9, 22, 21), -33.8688, 151.2093), 15.033, 79.7834, 0.02);
    expectSun(sunPosition(utc(1950, 1, 15, 17, 30), 40.7128, -74.006), 27.8853, 186.4727, 0.02);
    expectSun(sunPosition(utc(2090, 7, 4, 14), 64.1466, -21.9426), 48.3787, 189.5676, 0.02);
    expectSun(sunPosition(utc(2024, 6, 21, 6, 30), -54.8019, -68.303), -52.0729, 134.1547, 0.02);
}

// From the same source: apparent minus true height at 1013.25 hPa, 10 degrees Celsius, 0.55 micrometres.
TEST(Sun, IsRaisedByRefraction) {
    EXPECT_NEAR(refraction(10.5197), 0.0836, 0.005);
    EXPECT_NEAR(refraction(39.8723), 0.0194, 0.005);
    EXPECT_NEAR(refraction(89), 0, 0.001);
    // At sunset the sun's centre is 34 minutes below: the almanacs' convention.
    EXPECT_NEAR(refraction(-34.0 / 60), 34.0 / 60, 0.05);
}

TEST(Sun, PointsAlongNorthEastAndUp) {
    const Vec3 y_up{0, 1, 0}, z_up{0, 0, 1};
    expectVector(defaultNorth(y_up), 0, 0, -1);
    expectVector(defaultNorth(z_up), 0, 1, 0);
    expectVector(sunDirection({0, 0}, y_up, {0, 0, -1}), 0, 0, -1);
    expectVector(sunDirection({0, 90}, y_up, {0, 0, -1}), 1, 0, 0);
    expectVector(sunDirection({90, 123}, y_up, {0, 0, -1}), 0, 1, 0);
    expectVector(sunDirection({0, 90}, z_up, {0, 1, 0}), 1, 0, 0);
    expectVector(sunDirection({30, 180}, z_up, {0, 3, 5}), 0, -std::sqrt(0.75), 0.5);
}

} // namespace
} // namespace pointrt

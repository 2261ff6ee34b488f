// SPDX-License-Identifier: Apache-2.0
// Directions of the sun over days, and of the sky. tests/runtime/scene/test_sun.cpp tests the position of the sun.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <numeric>

#include "pointrt/studies.hpp"
#include "tests/support/says.h"

namespace pointrt {
namespace {

double sumOf(const Lights& lights) { return std::accumulate(lights.weights.begin(), lights.weights.end(), 0.0); }

double hoursOf(GeoPlace place, CalendarDate first, CalendarDate last, double every_min = 1) {
    return sumOf(sunLights({place, first, last, every_min, {}}, {}));
}

/// Elevation of light k in degrees.
double elevationOf(const Lights& lights, std::size_t k) {
    return std::asin(lights.directions[3 * k + 2]) * 180 / std::numbers::pi;
}

/// Hours between rise and set of the centre, with refraction of 34 arc minutes as in almanacs.
double dayLength(double latitude_deg, double declination_deg) {
    constexpr double kDegree = std::numbers::pi / 180;
    const double a = latitude_deg * kDegree, d = declination_deg * kDegree;
    const double cosine = (std::sin(-34.0 / 60 * kDegree) - std::sin(a) * std::sin(d)) / (std::cos(a) * std::cos(d));
    return 2 * std::acos(cosine) / kDegree / 15;
}

TEST(SunLights, DaysHaveTheirAstronomicalLength) {
    constexpr double kObliquity = 23.436; // the declination of the solstices
    EXPECT_NEAR(hoursOf({0, 0}, {2026, 3, 20}, {2026, 3, 20}), dayLength(0, 0), 0.03);
    EXPECT_NEAR(hoursOf({47.37, 8.54}, {2026, 6, 21}, {2026, 6, 21}), dayLength(47.37, kObliquity), 0.03);
    EXPECT_NEAR(hoursOf({-33.87, 151.21}, {2026, 6, 21}, {2026, 6, 21}), dayLength(-33.87, kObliquity), 0.03);
    EXPECT_NEAR(hoursOf({60, -150}, {2026, 12, 21}, {2026, 12, 21}), dayLength(60, -kObliquity), 0.04);
    EXPECT_NEAR(hoursOf({80, 20}, {2026, 6, 21}, {2026, 6, 21}), 24, 1e-9);
    EXPECT_EQ(hoursOf({80, 20}, {2026, 12, 21}, {2026, 12, 21}), 0);
}

TEST(SunLights, WeightsAreTheIntervalsAndTheLastOneMayBeShort) {
    const Lights polar = sunLights({{80, 20}, {2026, 6, 21}, {2026, 6, 22}, 7, {}}, {});
    EXPECT_EQ(polar.weights.size(), 412u); // 2880 / 7 = 411.4
    EXPECT_NEAR(polar.weights[0], 7.0 / 60, 1e-12);
    EXPECT_NEAR(polar.weights.back(), 3.0 / 60, 1e-9);
    EXPECT_NEAR(sumOf(polar), 48, 1e-9);
}

TEST(SunLights, AreInTheSouthAtNoonAndRotateWithNorth) {
    const SunStudy study{{47.37, 8.54}, {2026, 6, 21}, {2026, 6, 21}, 1, {}};
    const Lights sun = sunLights(study, {});
    std::size_t highest = 0;
    for (std::size_t k = 0; k < sun.weights.size(); ++k)
        if (elevationOf(sun, k) > elevationOf(sun, highest)) highest = k;
    EXPECT_NEAR(elevationOf(sun, highest), 90 - 47.37 + 23.43,
                0.03); // declination at the solstice, and some refraction
    EXPECT_NEAR(sun.directions[3 * highest], 0, 0.01);
    EXPECT_LT(sun.directions[3 * highest + 1], 0);
    EXPECT_GT(sun.directions[0], 0.5) << "it rises in the east";
    const Lights turned = sunLights(study, {{0, 0, 1}, {1, 0, 0}, ""}); // +X is north, so -Y is east
    EXPECT_NEAR(turned.directions[3 * highest], sun.directions[3 * highest + 1], 1e-12);
    EXPECT_NEAR(turned.directions[1], -sun.directions[0], 1e-12);
    const Lights upright = sunLights(study, {{0, 1, 0}, {0, 0, -1}, ""});
    EXPECT_NEAR(upright.directions[3 * highest + 1], sun.directions[3 * highest + 2], 1e-12);
}

TEST(SunLights, DaysBeginAtMidnightOfTheUtcOffset) {
    EXPECT_EQ(utcOffsetOf({0, 8.54}), 1);
    EXPECT_EQ(utcOffsetOf({0, -123}), -8);
    EXPECT_EQ(utcOffsetOf({0, 7.4}), 0);
    // a UTC day in Auckland begins during daylight and contains parts of two solar days
    const SunStudy day{{-36.85, 174.76}, {2026, 3, 20}, {2026, 3, 20}, 30, {}};
    SunStudy utc = day;
    utc.utc_offset_h = 0;
    const Lights here = sunLights(day, {}), there = sunLights(utc, {});
    EXPECT_LT(elevationOf(here, 0), 10);
    EXPECT_GT(elevationOf(there, 0), 40);
    EXPECT_NEAR(sumOf(here), sumOf(there), 0.5);
}

std::string refusalOf(const SunStudy& study) {
    try {
        sunLights(study, {});
    } catch (const TraceError& error) {
        EXPECT_EQ(error.kind, TraceError::Kind::kBadUsage);
        return error.what();
    }
    return "";
}

TEST(SunLights, InvalidPlacesAndDatesAreRefused) {
    const SunStudy good{{47, 8}, {2026, 2, 28}, {2026, 3, 1}, 15, {}};
    EXPECT_EQ(refusalOf(good), "");
    const auto with = [&](auto change) {
        SunStudy study = good;
        change(study);
        return refusalOf(study);
    };
    EXPECT_SAYS(with([](SunStudy& s) { s.first.day = 30; }), "*date *exist");
    EXPECT_SAYS(with([](SunStudy& s) { s.first.month = 13; }), "*date *exist");
    EXPECT_SAYS(with([](SunStudy& s) { s.first.year = 1600; }), "*date *1900 *2100");
    EXPECT_SAYS(with([](SunStudy& s) { s.last = {2026, 2, 27}; }), "*last *before");
    EXPECT_SAYS(with([](SunStudy& s) { s.every_min = 0; }), "*interval *0 *1440");
    EXPECT_SAYS(with([](SunStudy& s) { s.every_min = std::nan(""); }), "*interval *0 *1440");
    EXPECT_SAYS(with([](SunStudy& s) { s.every_min = 1e-9; }), "*million instants");
    EXPECT_SAYS(with([](SunStudy& s) { s.place.latitude_deg = 91; }), "*latitude *-90 *90");
    EXPECT_SAYS(with([](SunStudy& s) { s.place.longitude_deg = std::nan(""); }), "*longitude *-180 *180");
    EXPECT_SAYS(with([](SunStudy& s) { s.utc_offset_h = 25; }), "*offset *-24 *24");
}

TEST(SkyLights, AreUpAndUniformOnTheUnitDisc) {
    const Lights sky = skyLights(256, {});
    ASSERT_EQ(sky.weights.size(), 256u);
    EXPECT_NEAR(sumOf(sky), 1, 1e-12);
    double mean_up = 0;
    for (std::size_t k = 0; k < 256; ++k) {
        const double* d = sky.directions.data() + 3 * k;
        EXPECT_NEAR(std::hypot(d[0], d[1], d[2]), 1, 1e-12);
        EXPECT_GT(d[2], 0);
        mean_up += d[2] / 256;
    }
    EXPECT_NEAR(mean_up, 2.0 / 3, 0.002); // the mean cosine of a cosine-weighted hemisphere
    EXPECT_EQ(sky.directions, skyLights(256, {}).directions);
    EXPECT_THROW(skyLights(0, {}), TraceError);
    EXPECT_THROW(skyLights(65537, {}), TraceError);
}

/// The sky view factor of a round basin is the squared cosine of the elevation of its horizon.
TEST(SkyLights, GiveTheSkyViewFactorOfABasin) {
    const Lights sky = skyLights(4096, {});
    for (const double horizon_deg : {10.0, 30.0, 45.0, 70.0}) {
        double open = 0;
        for (std::size_t k = 0; k < sky.weights.size(); ++k)
            if (elevationOf(sky, k) > horizon_deg) open += sky.weights[k];
        EXPECT_NEAR(open, std::pow(std::cos(horizon_deg * std::numbers::pi / 180), 2), 0.005) << horizon_deg;
    }
}

} // namespace
} // namespace pointrt

// SPDX-License-Identifier: Apache-2.0
#include "runtime/session/sun_option.h"

#include <gtest/gtest.h>

#include <stdexcept>

#include "format/base/error.h"
#include "runtime/scene/sun.h"
#include "tests/support/says.h"

namespace pointrt {
namespace {

constexpr double kHalfYearMorning_s = 1782000000; // 2026-06-21T00:00Z

TEST(SunOption, TimesHaveZonesAndPlaces) {
    EXPECT_EQ(parseSun("2026-06-21T15:30").local_s, kHalfYearMorning_s + 15.5 * 3600);
    EXPECT_FALSE(parseSun("2026-06-21T15:30").zone_offset_s);
    EXPECT_FALSE(parseSun("2026-06-21T15:30").place);
    EXPECT_EQ(parseSun("2026-06-21T15:30Z").zone_offset_s, 0);
    EXPECT_EQ(parseSun("2026-06-21T15:30-03:30").zone_offset_s, -3.5 * 3600);
    EXPECT_EQ(parseSun("2026-06-21T15:30+14:00").zone_offset_s, 14 * 3600);
    const SunOption there = parseSun("2026-06-21T15:30+02:00@-33.5,151");
    EXPECT_EQ(there.place->latitude_deg, -33.5);
    EXPECT_EQ(there.place->longitude_deg, 151);
    EXPECT_EQ(there.zone_offset_s, 2 * 3600);
}

TEST(SunOption, OtherTextsAreRefused) {
    for (const char* text :
         {"", "noon", "2026-06-21", "2026-06-31T10:00", "2026-13-01T10:00", "2026-06-21T24:00", "2026-06-21T10:60",
          "1026-06-21T10:00", "2026-06-21T10:00+15:00", "2026-06-21T10:00+02", "2026-06-21T10:00 Z",
          "2026-06-21T10:00@", "2026-06-21T10:00@44", "2026-06-21T10:00@91,0", "2026-06-21T10:00@0,181",
          "2026-06-21T10:00@a,b", "2026-06-21T10:00@1,2,3", "2026-06-21T10:00Z@nan,0"})
        EXPECT_THROW(parseSun(text), std::invalid_argument) << text;
}

SceneDescription sunny(const std::string& text) {
    SceneDescription scene;
    scene.path = "site.pro";
    addSun(scene, parseSun(text));
    return scene;
}

TEST(SunOption, TheSunStandsWhereTheSkyHasIt) {
    // Eugene in Oregon, and the same hour in the zone that its longitude suggests
    for (const char* text : {"2026-06-21T15:00-08:00@44.058,-123.068", "2026-06-21T15:00@44.058,-123.068",
                             "2026-06-21T23:00Z@44.058,-123.068"}) {
        const SceneDescription scene = sunny(text);
        ASSERT_EQ(scene.lights.size(), 1u);
        ASSERT_EQ(scene.suns.size(), 1u);
        const SunPosition expected = sunPosition(kHalfYearMorning_s + 23 * 3600, 44.058, -123.068);
        EXPECT_NEAR(scene.suns[0].position.elevation_deg, expected.elevation_deg, 0.05) << "but for refraction";
        EXPECT_NEAR(scene.suns[0].position.azimuth_deg, expected.azimuth_deg, 1e-9);
        EXPECT_TRUE(scene.sky);
        EXPECT_EQ(scene.render.integrator, Integrator::kPath);
    }
}

TEST(SunOption, TurnsTheSunOfAScene) {
    SceneDescription scene;
    scene.path = "site.toml";
    scene.lights = {PointLight{}, SunLight{{0, 0, 1}, 1, {7, 7, 7}}};
    scene.suns = {{1, {10, 20}, {}, ""}};
    addSun(scene, parseSun("2026-06-21T12:00Z@45,0"));
    EXPECT_EQ(scene.lights.size(), 2u);
    ASSERT_EQ(scene.suns.size(), 1u);
    EXPECT_EQ(scene.suns[0].light, 1u);
    EXPECT_NEAR(scene.suns[0].position.elevation_deg, 68.4, 0.1); // 90 - 45 + 23.4
    EXPECT_FALSE(scene.render.integrator) << "as the scene file says";
}

TEST(SunOption, WhatCannotBeIsSaid) {
    const auto refusalOf = [](const std::string& text) {
        try {
            sunny(text);
        } catch (const Error& error) {
            return std::string(error.what());
        }
        return std::string();
    };
    EXPECT_SAYS(refusalOf("2026-06-21T23:30@45,0"), "--sun: *below the horizon*");
    EXPECT_SAYS(refusalOf("2026-06-21T12:00"), "--sun: site.pro *where*TIME@LATITUDE,LONGITUDE");
}

} // namespace
} // namespace pointrt

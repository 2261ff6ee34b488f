// SPDX-License-Identifier: Apache-2.0
#include <chrono>
#include <cmath>
#include <cstdio>
#include <numbers>

#include "runtime/scene/sun.h"
#include "runtime/scene_file/read_parts.h"
#include "shaders/shared/scene_layout.h"

namespace pointrt {
namespace {

Color scaled(Color color, double factor) {
    for (float& channel : color) channel = static_cast<float>(channel * factor);
    return color;
}

/// The light's colour times its strength, under key: a number that multiplies "color", or a colour itself.
Color strengthOf(const SceneValue& table, std::string_view key) {
    const SceneValue strength = require(table, key);
    const auto color = find(table, "color");
    if (strength.node->is_number()) return scaled(color ? colorOf(*color) : Color{1, 1, 1}, numberOf(strength, kLight));
    if (color) refuse(*color, "\"" + std::string(key) + "\" is a colour already; make it a number");
    return colorOf(strength, kLight);
}

/// The same, or from "power" in watts, of which each of red, green and blue gets the colour's share: watts_of_one is
/// the power of a lamp whose key is 1.
Color strengthOrPower(const SceneValue& table, std::string_view key, double watts_of_one) {
    if (hasFirst(table, key, "power")) return strengthOf(table, key);
    Color color{1, 1, 1};
    takeColor(table, "color", kShare, color);
    return scaled(color, numberOf(require(table, "power"), kLight) / watts_of_one);
}

PointLight readPoint(const SceneValue& table) {
    requireKnownKeys(table, "a point light", {"type", "position", "color", "intensity", "power"});
    return {vectorOf(require(table, "position")), strengthOrPower(table, "intensity", 4 * std::numbers::pi)};
}

SpotLight readSpot(const SceneValue& table) {
    requireKnownKeys(table, "a spot light",
                     {"type", "position", "target", "direction", "outer", "inner", "color", "intensity"});
    SpotLight light;
    light.position = vectorOf(require(table, "position"));
    if (hasFirst(table, "target", "direction")) {
        const SceneValue target = require(table, "target");
        const Vec3 ahead = vectorOf(target) - light.position;
        if (length(ahead) < kSmallest) refuse(target, "must be another point than \"position\"");
        light.direction = normalize(ahead);
    } else {
        light.direction = directionOf(require(table, "direction"));
    }
    const double undimmed = light.inner_deg / light.outer_deg;
    takeNumber(table, "outer", {0.1, 90}, light.outer_deg);
    light.inner_deg = undimmed * light.outer_deg;
    takeNumber(table, "inner", {0, light.outer_deg}, light.inner_deg);
    light.intensity = strengthOf(table, "intensity");
    return light;
}

double unixSecondsOf(const SceneValue& value) {
    const auto* moment = value.node->as_date_time();
    if (!moment || !moment->get().offset)
        refuse(value, "must be a date and time with the offset from UTC, as 2026-06-21T18:30:00+02:00");
    const auto& [date, time, offset] = moment->get();
    if (date.year < 1900 || date.year > 2100) refuse(value, "must be from 1900 to 2100");
    const std::chrono::sys_days day = std::chrono::year{date.year} / date.month / date.day;
    const double days = static_cast<double>(day.time_since_epoch().count());
    const double minutes = 1440 * days + 60.0 * time.hour + time.minute - offset->minutes;
    return 60 * minutes + time.second + 1e-9 * time.nanosecond;
}

Vec3 northOf(const SceneValue& table, Vec3 up) {
    const auto value = find(table, "north");
    if (!value) return defaultNorth(up);
    const Vec3 north = directionOf(*value);
    if (length(cross(north, up)) < kSmallest) refuse(*value, "must not be along the scene's \"up\"");
    return north;
}

/// Towards the sun as it is seen at a place and time.
Vec3 sunSeenFrom(const SceneValue& table, Vec3 up) {
    const SceneValue time = require(table, "time");
    const double latitude_deg = numberOf(require(table, "latitude"), {-90, 90});
    const double longitude_deg = numberOf(require(table, "longitude"), {-180, 180});
    SunPosition sun = sunPosition(unixSecondsOf(time), latitude_deg, longitude_deg);
    sun.elevation_deg += refraction(sun.elevation_deg);
    if (!(sun.elevation_deg > 0)) {
        char depth[32];
        std::snprintf(depth, sizeof depth, "%.1f", -sun.elevation_deg);
        refuse(time, std::string("the sun is ") + depth + " degrees below the horizon at that time and place");
    }
    return sunDirection(sun, up, northOf(table, up));
}

SunLight readSun(const SceneValue& table, Vec3 up) {
    requireKnownKeys(
        table, "a sun",
        {"type", "towards", "time", "latitude", "longitude", "north", "angular_radius", "color", "irradiance"});
    SunLight light;
    if (hasFirst(table, "towards", "time")) {
        forbid(table, {"latitude", "longitude", "north"}, "says nothing without \"time\"");
        light.towards = directionOf(require(table, "towards"));
    } else {
        light.towards = sunSeenFrom(table, up);
    }
    takeNumber(table, "angular_radius", {0, 45}, light.radius_deg);
    light.irradiance = strengthOf(table, "irradiance");
    return light;
}

SphereLight readSphere(const SceneValue& table) {
    requireKnownKeys(table, "a sphere light",
                     {"type", "center", "radius", "color", "radiance", "power", "seen_by_camera"});
    SphereLight light;
    light.center = vectorOf(require(table, "center"));
    light.radius = numberOf(require(table, "radius"), kLengths);
    const double area = 4 * std::numbers::pi * light.radius * light.radius;
    light.radiance = strengthOrPower(table, "radiance", std::numbers::pi * area);
    takeFlag(table, "seen_by_camera", light.seen_by_camera);
    return light;
}

QuadLight readQuad(const SceneValue& table) {
    requireKnownKeys(table, "a quad light",
                     {"type", "center", "u", "v", "color", "radiance", "power", "seen_by_camera"});
    const HalfEdges edges = halfEdgesOf(table);
    const double both_sides = 2 * 4 * length(edges.u) * length(edges.v);
    QuadLight light;
    light.center = vectorOf(require(table, "center"));
    light.u = edges.u;
    light.v = edges.v;
    light.radiance = strengthOrPower(table, "radiance", std::numbers::pi * both_sides);
    takeFlag(table, "seen_by_camera", light.seen_by_camera);
    return light;
}

LightDescription lightOf(const SceneValue& table, const SceneReading& reading) {
    const std::size_t type = choiceOf(require(table, "type"), {"point", "spot", "sun", "sphere", "quad"});
    constexpr std::size_t sphere = 3; // it and what follows have a surface
    if (type >= sphere) requireRoomForShape(table, reading);
    switch (type) {
    case 0:
        return readPoint(table);
    case 1:
        return readSpot(table);
    case 2:
        return readSun(table, reading.scene.up.value_or(Vec3{0, 1, 0}));
    case sphere:
        return readSphere(table);
    default:
        return readQuad(table);
    }
}

} // namespace

void readLights(const SceneValue& file, SceneReading& reading) {
    for (const SceneValue& table : findTables(file, "light")) {
        if (reading.scene.lights.size() == MAX_LIGHTS) refuse(table, "there are at most 32 lights");
        reading.scene.lights.push_back(lightOf(table, reading));
    }
}

} // namespace pointrt

// SPDX-License-Identifier: Apache-2.0
#include <chrono>
#include <cmath>
#include <cstdio>

#include "runtime/scene/sun.h"
#include "runtime/scene_io/read_parts.h"
#include "runtime/util/pack.h"
#include "shaders/shared/scene_layout.h"

namespace pointrt {
namespace {

/// The strength of a light, read from key: either a number, which is multiplied by "color", or a colour.
Color strengthOf(const SceneValue& table, std::string_view key) {
    const SceneValue strength = require(table, key);
    const auto color = find(table, "color");
    if (strength.node->is_number())
        return scaled(color ? colorOf(*color) : Color{1, 1, 1}, numberOf(strength, kLightValues));
    if (color) refuse(*color, "\"" + std::string(key) + "\" is a colour already; make it a number");
    return colorOf(strength, kLightValues);
}

/// The same; alternatively from "power" in watts, multiplied by "color". watts_of_one: power of a light of strength 1.
Color strengthOrPower(const SceneValue& table, std::string_view key, double watts_of_one) {
    if (hasFirst(table, key, "power")) return strengthOf(table, key);
    Color color{1, 1, 1};
    takeColor(table, "color", kShares, color);
    return scaled(color, numberOf(require(table, "power"), kLightValues) / watts_of_one);
}

double unixSecondsOf(const SceneValue& value) {
    const auto* moment = value.node->as_date_time();
    if (!moment || !moment->get().offset)
        refuse(value, "must be a date and time with the offset from UTC, without quotes: 2026-06-21T18:30:00+02:00");
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

/// The apparent position of the sun at a place and time.
SunPosition sunSeenFrom(const SceneValue& table) {
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
    return sun;
}

/// The direction to the sun if the scene's up is known; else adds it to scene.suns for later.
Vec3 directionOfSun(const SceneValue& table, SceneReading& reading) {
    const SunPosition sun = sunSeenFrom(table);
    if (reading.scene.up) return sunDirection(sun, *reading.scene.up, northOf(table, *reading.scene.up));
    const auto north = find(table, "north");
    SunInTheSky later{static_cast<std::uint32_t>(reading.scene.lights.size()), sun, {}, placeOf(north.value_or(table))};
    if (north) later.north = directionOf(*north);
    reading.scene.suns.push_back(later);
    return {0, 1, 0};
}

/// Reads the value of each type of field.
struct FieldReader {
    const SceneValue& table;
    SceneReading& reading;

    void operator()(const PositionField& field) const { field.value = vectorOf(require(table, field.key)); }

    void operator()(const AimField& field) const {
        if (!hasFirst(table, "target", field.key)) {
            field.value = directionOf(require(table, field.key));
            return;
        }
        const SceneValue target = require(table, "target");
        const Vec3 ahead = vectorOf(target) - field.from.value;
        if (length(ahead) < kSmallest) refuse(target, "must differ from \"" + std::string(field.from.key) + "\"");
        field.value = normalize(ahead);
    }

    void operator()(const SunwardField& field) const {
        if (!hasFirst(table, "towards", "time")) {
            field.value = directionOfSun(table, reading);
            return;
        }
        forbid(table, {"latitude", "longitude", "north"}, "has no effect without \"time\"");
        field.value = directionOf(require(table, "towards"));
    }

    void operator()(const ConeField& field) const {
        const double inner_share = field.inner_deg / field.outer_deg;
        takeNumber(table, "outer", {ConeField::kNarrowest, ConeField::kWidest}, field.outer_deg);
        field.inner_deg = inner_share * field.outer_deg;
        takeNumber(table, "inner", {0, field.outer_deg}, field.inner_deg);
    }

    void operator()(const AngularRadiusField& field) const {
        takeNumber(table, "angular_radius", {0, AngularRadiusField::kWidest}, field.degrees);
    }

    void operator()(const RadiusField& field) const { field.value = numberOf(require(table, "radius"), kLengths); }

    void operator()(const HalfEdgesField& field) const {
        const HalfEdges edges = halfEdgesOf(table);
        field.u = edges.u;
        field.v = edges.v;
    }

    void operator()(const VisibleField& field) const { takeFlag(table, "seen_by_camera", field.value); }

    void operator()(const LayerField& field) const {
        takeFlag(table, "visible", field.visible);
        takeLayer(table, field.layer);
    }

    void operator()(const EmissionField& field) const {
        field.value = field.watts_of_one ? strengthOrPower(table, field.key(), *field.watts_of_one)
                                         : strengthOf(table, field.key());
    }
};

template <typename L>
LightDescription readKind(const SceneValue& table, SceneReading& reading) {
    L light;
    FieldKeys keys{"type"};
    light.eachField([&](const auto& field) {
        for (const std::string_view key : field.keys()) keys.push_back(key);
    });
    requireKnownKeys(table, L::kNames.called, keys);
    light.eachField(FieldReader{table, reading});
    return light;
}

std::size_t lightKindOf(const SceneValue& type) {
    std::vector<std::string_view> types;
    for (std::size_t kind = 0; kind < kLightKinds; ++kind) types.push_back(namesOf(kind).type);
    return choiceOf(type, types);
}

LightDescription lightOf(const SceneValue& table, SceneReading& reading) {
    const std::size_t kind = lightKindOf(require(table, "type"));
    if (hasSurface(kind)) requireRoomForShape(table, reading);
    LightDescription light;
    eachLightKind([&](auto type, std::size_t number) {
        if (number == kind) light = readKind<typename decltype(type)::type>(table, reading);
    });
    return light;
}

} // namespace

void readLights(const SceneValue& file, SceneReading& reading) {
    for (const SceneValue& table : findTables(file, "light")) {
        if (reading.scene.lights.size() == MAX_LIGHTS) refuse(table, "more than 32 lights");
        reading.scene.lights.push_back(lightOf(table, reading));
    }
}

} // namespace pointrt

// SPDX-License-Identifier: Apache-2.0
#include "runtime/session/sun_option.h"

#include <chrono>
#include <cmath>
#include <cstdio>
#include <stdexcept>
#include <variant>

#include "format/base/error.h"
#include "runtime/scene/sun.h"
#include "runtime/util/parse.h"

namespace pointrt {
namespace {

constexpr double kHour_s = 3600, kMinute_s = 60, kDay_s = 86400;
/// Zones are from UTC-12 to UTC+14.
constexpr double kFarthestZone_s = 14 * kHour_s;
/// Irradiance on a surface that faces the sun: together with the default sky, it makes a white level ground in the
/// afternoon white.
constexpr float kSunIrradiance = 4;
constexpr const char* kForm = "\" is not a date and a time such as 2026-06-21T15:00, 2026-06-21T15:00-07:00 or "
                              "2026-06-21T15:00@44.06,-123.07";

[[noreturn]] void refuseTime(const std::string& text) { throw std::invalid_argument("\"" + text + kForm); }

/// Parses "2026-06-21T15:00" to seconds since 1970-01-01 00:00. length receives the number of characters parsed.
double parseLocalTime(const std::string& text, std::size_t& length) {
    int year = 0, month = 0, day = 0, hour = 0, minute = 0, end = 0;
    if (std::sscanf(text.c_str(), "%4d-%2d-%2dT%2d:%2d%n", &year, &month, &day, &hour, &minute, &end) != 5)
        refuseTime(text);
    const std::chrono::year_month_day date{std::chrono::year{year}, std::chrono::month{static_cast<unsigned>(month)},
                                           std::chrono::day{static_cast<unsigned>(day)}};
    const bool is_time = hour >= 0 && hour < 24 && minute >= 0 && minute < 60;
    if (!date.ok() || year < 1900 || year > 2100 || !is_time) refuseTime(text); // the range of sunPosition
    length = static_cast<std::size_t>(end);
    return kDay_s * static_cast<double>(std::chrono::sys_days(date).time_since_epoch().count()) + kHour_s * hour +
           kMinute_s * minute;
}

/// Parses "", "Z", or "-07:00".
std::optional<double> parseZone(const std::string& zone, const std::string& text) {
    if (zone.empty()) return std::nullopt;
    if (zone == "Z") return 0;
    int hours = 0, minutes = 0, end = 0;
    const bool is_signed = zone[0] == '+' || zone[0] == '-';
    if (!is_signed || std::sscanf(zone.c_str() + 1, "%2d:%2d%n", &hours, &minutes, &end) != 2) refuseTime(text);
    const double offset_s = kHour_s * hours + kMinute_s * minutes;
    const bool is_valid = hours >= 0 && minutes >= 0 && minutes < 60 && offset_s <= kFarthestZone_s;
    if (static_cast<std::size_t>(end) + 1 != zone.size() || !is_valid) refuseTime(text);
    return zone[0] == '-' ? -offset_s : offset_s;
}

EarthPlace parsePlace(const std::string& place, const std::string& text) {
    const std::size_t comma = place.find(',');
    double latitude = 0, longitude = 0;
    if (comma == std::string::npos || !parseNumber(place.substr(0, comma), latitude) ||
        !parseNumber(place.substr(comma + 1), longitude) || !(std::abs(latitude) <= 90) ||
        !(std::abs(longitude) <= 180))
        refuseTime(text);
    return {latitude, longitude};
}

EarthPlace placeOf(const SceneDescription& scene, const SunOption& sun) {
    if (sun.place) return *sun.place;
    if (const auto place = earthPlaceOf(scene)) return *place;
    throw Error{ExitCode::kBadUsage,
                "--sun: " + scene.path +
                    " does not say where on the Earth it is; add the place as TIME@LATITUDE,LONGITUDE"};
}

SunPosition positionOf(const SunOption& sun, const EarthPlace& place) {
    constexpr double kDegreesAnHour = 15;
    const double zone_s = sun.zone_offset_s.value_or(kHour_s * std::round(place.longitude_deg / kDegreesAnHour));
    SunPosition position = sunPosition(sun.local_s - zone_s, place.latitude_deg, place.longitude_deg);
    position.elevation_deg += refraction(position.elevation_deg);
    if (!(position.elevation_deg > 0))
        throw Error{ExitCode::kBadUsage, "--sun: the sun is " + plainText(-position.elevation_deg) +
                                             " degrees below the horizon at that time and place"};
    position.azimuth_deg -= place.convergence_deg; // the map's north differs from true north
    return position;
}

/// The index of the first sun; adds a sun if the scene has no sun.
std::uint32_t sunOf(SceneDescription& scene) {
    for (std::size_t i = 0; i < scene.lights.size(); ++i)
        if (std::holds_alternative<SunLight>(scene.lights[i])) return static_cast<std::uint32_t>(i);
    scene.lights.push_back(
        SunLight{{0, 0, 1}, SunLight{}.radius_deg, {kSunIrradiance, kSunIrradiance, kSunIrradiance}});
    return static_cast<std::uint32_t>(scene.lights.size() - 1);
}

} // namespace

SunOption parseSun(const std::string& text) {
    SunOption sun;
    std::size_t end = 0;
    sun.local_s = parseLocalTime(text, end);
    const std::size_t at = text.find('@');
    sun.zone_offset_s = parseZone(text.substr(end, at == std::string::npos ? at : at - end), text);
    if (at != std::string::npos) sun.place = parsePlace(text.substr(at + 1), text);
    return sun;
}

void addSun(SceneDescription& scene, const SunOption& sun) {
    const SunPosition position = positionOf(sun, placeOf(scene, sun));
    if (scene.lights.empty()) {
        if (!scene.render.integrator && !scene.render.spp) scene.render.spp = kDefaultPathSpp;
        if (!scene.render.integrator) scene.render.integrator = Integrator::kPath;
    }
    const std::uint32_t number = sunOf(scene);
    std::erase_if(scene.suns, [&](const SunInTheSky& each) { return each.light == number; });
    scene.suns.push_back({number, position, {}, "--sun: "});
    if (!scene.sky) scene.sky = SkyDescription{};
}

} // namespace pointrt

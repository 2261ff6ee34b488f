// SPDX-License-Identifier: Apache-2.0
#include <chrono>
#include <cmath>

#include "pointrt/studies.hpp"
#include "runtime/scene/sun.h"
#include "runtime/studies/study_values.h"
#include "runtime/util/vec.h"

namespace pointrt {
namespace {

constexpr double kDayMinutes = 1440;
constexpr double kMostInstants = 1e6; // two years at one minute; 32 MB of directions

/// Days since 1970.
double dayNumber(CalendarDate date) {
    const std::chrono::year_month_day day{std::chrono::year(date.year), std::chrono::month(date.month),
                                          std::chrono::day(date.day)};
    if (!day.ok()) refuseUsage("the date does not exist");
    if (date.year < 1900 || date.year > 2100)
        refuseUsage("the date must be from 1900 to 2100, where the solar position is accurate");
    return static_cast<double>(std::chrono::sys_days(day).time_since_epoch().count());
}

void requireStudy(const SunStudy& study) {
    if (!(std::abs(study.place.latitude_deg) <= 90)) refuseUsage("the latitude must be from -90 to 90 degrees");
    if (!(std::abs(study.place.longitude_deg) <= 180)) refuseUsage("the longitude must be from -180 to 180 degrees");
    if (!(study.every_min > 0 && study.every_min <= kDayMinutes))
        refuseUsage("the interval must be above 0 and at most 1440 minutes");
    if (study.utc_offset_h && !(std::abs(*study.utc_offset_h) <= 24))
        refuseUsage("the UTC offset must be from -24 to 24 hours");
}

} // namespace

double utcOffsetOf(GeoPlace place) {
    constexpr double kDegreesPerHour = 15;
    return std::round(place.longitude_deg / kDegreesPerHour);
}

Lights sunLights(const SunStudy& study, const StudyFrame& frame) {
    requireStudy(study);
    const double first = dayNumber(study.first), last = dayNumber(study.last);
    if (last < first) refuseUsage("the last day is before the first");
    const double minutes = kDayMinutes * (last - first + 1);
    if (minutes / study.every_min > kMostInstants)
        refuseUsage("more than a million instants: choose fewer days or a longer interval");
    const double start = 60 * (kDayMinutes * first - 60 * study.utc_offset_h.value_or(utcOffsetOf(study.place)));
    Lights lights;
    for (double k = 0; k * study.every_min < minutes; ++k) {
        const double from = k * study.every_min, to = std::min(minutes, from + study.every_min);
        SunPosition sun = sunPosition(start + 30 * (from + to), study.place.latitude_deg, study.place.longitude_deg);
        sun.elevation_deg += refraction(sun.elevation_deg);
        if (!(sun.elevation_deg > 0)) continue;
        const Vec3 towards = sunDirection(sun, vectorOf(frame.up), vectorOf(frame.north));
        lights.directions.insert(lights.directions.end(), {towards.x, towards.y, towards.z});
        lights.weights.push_back((to - from) / 60);
    }
    return lights;
}

} // namespace pointrt

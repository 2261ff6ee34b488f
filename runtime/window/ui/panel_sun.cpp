// SPDX-License-Identifier: Apache-2.0
// The sun's direction from place, date and time.
#include <imgui.h>

#include <chrono>
#include <cmath>
#include <cstdio>
#include <utility>

#include "runtime/scene/sun.h"
#include "runtime/window/ui/panel_edit.h"
#include "runtime/window/ui/panel_parts.h"
#include "runtime/window/ui/panel_widgets.h"

namespace pointrt {
namespace {

/// Place and time in the panel. Initially Greenwich, a midsummer afternoon.
struct SunDate {
    float latitude_deg, longitude_deg, hour;
    int day_of_year, year;
};

SunDate storedDate() {
    return {storedFloat("sun latitude", 51.48f), storedFloat("sun longitude", 0), storedFloat("sun hour", 15),
            storedInt("sun day", 172), storedInt("sun year", 2025)};
}

void storeDate(const SunDate& date) {
    storedFloat("sun latitude", 0) = date.latitude_deg;
    storedFloat("sun longitude", 0) = date.longitude_deg;
    storedFloat("sun hour", 0) = date.hour;
    storedInt("sun day", 0) = date.day_of_year;
    storedInt("sun year", 0) = date.year;
}

std::chrono::sys_days dayOf(const SunDate& date) {
    using namespace std::chrono;
    return sys_days(year{date.year} / January / 1) + days(date.day_of_year - 1);
}

/// "21 June"
void dayText(const SunDate& date, char (&text)[32]) {
    constexpr const char* months[] = {"January", "February", "March",     "April",   "May",      "June",
                                      "July",    "August",   "September", "October", "November", "December"};
    const std::chrono::year_month_day day(dayOf(date));
    std::snprintf(text, sizeof text, "%u %s", static_cast<unsigned>(day.day()),
                  months[static_cast<unsigned>(day.month()) - 1]);
}

/// Uses the scan's place on the Earth once it is known.
void takePlace(Workspace& w, SunDate& date) {
    if (!w.place_sought) w.requests.find_place = true;
    if (!w.earth_place || std::exchange(w.place_taken, true)) return;
    date.latitude_deg = static_cast<float>(w.earth_place->latitude_deg);
    date.longitude_deg = static_cast<float>(w.earth_place->longitude_deg);
}

/// The time in the zone that the longitude suggests: legal time may differ by an hour or two.
void zoneText(const SunDate& date) {
    constexpr float kDegreesAnHour = 15, kDay = 24;
    const float zone = std::round(date.longitude_deg / kDegreesAnHour);
    const float local = std::fmod(date.hour + zone + kDay, kDay);
    ImGui::TextDisabled("%02d:%02d at UTC%+d, from the longitude", static_cast<int>(local),
                        static_cast<int>(60 * (local - std::floor(local))), static_cast<int>(zone));
}

SunPosition positionAt(const SunDate& date) {
    const double days = static_cast<double>(dayOf(date).time_since_epoch().count());
    SunPosition sun = sunPosition(86400 * days + 3600 * static_cast<double>(date.hour),
                                  static_cast<double>(date.latitude_deg), static_cast<double>(date.longitude_deg));
    sun.elevation_deg += refraction(sun.elevation_deg);
    return sun;
}

bool dateRows(Requests& requests, SunDate& date) {
    char day[32], hour[16];
    dayText(date, day);
    std::snprintf(hour, sizeof hour, "%02d:%02d UTC", static_cast<int>(date.hour),
                  static_cast<int>(60 * (date.hour - static_cast<float>(static_cast<int>(date.hour)))));
    const auto note = [&](bool changed) { return reportEdit(requests, Edit::kScene, changed); };
    bool changed = note(sliderRow("Latitude", date.latitude_deg, {-90, 90}, "%.2f\xC2\xB0", "north is positive"));
    changed |= note(sliderRow("Longitude", date.longitude_deg, {-180, 180}, "%.2f\xC2\xB0", "east is positive"));
    auto year = static_cast<std::uint32_t>(date.year), day_of_year = static_cast<std::uint32_t>(date.day_of_year);
    changed |= note(sliderRow("Year", year, {1900, 2100}));
    pushRow("Day", "of the year");
    constexpr std::uint32_t first = 1, last = 365;
    changed |= note(ImGui::SliderScalar("##value", ImGuiDataType_U32, &day_of_year, &first, &last, day,
                                        ImGuiSliderFlags_AlwaysClamp));
    popRow();
    changed |= note(sliderRow("Hour", date.hour, {0, 24}, hour, "UTC: local time minus the time zone"));
    date.year = static_cast<int>(year);
    date.day_of_year = static_cast<int>(day_of_year);
    return changed;
}

} // namespace

void drawSunByDate(Workspace& w, Vec3& towards) {
    if (!ImGui::TreeNode("Place and date")) return;
    SunDate date = storedDate();
    takePlace(w, date);
    bool changed = dateRows(w.requests, date);
    changed |= reportEdit(w.requests, Edit::kScene, ImGui::Button("Set the sun", ImVec2(-1, 0)));
    storeDate(date);
    SunPosition position = positionAt(date);
    zoneText(date);
    if (w.earth_place) {
        position.azimuth_deg -= w.earth_place->convergence_deg; // the map's north differs from true north
        dimText("The place comes from the scan's coordinate system.");
    }
    const Vec3 up = sceneUpright(w);
    if (changed && position.elevation_deg > 0) towards = normalize(sunDirection(position, up, defaultNorth(up)));
    if (position.elevation_deg > 0)
        ImGui::TextDisabled("elevation %.1f\xC2\xB0, azimuth %.1f\xC2\xB0", position.elevation_deg,
                            position.azimuth_deg);
    else
        dimText("The sun is below the horizon then; it stays where it was.");
    ImGui::TreePop();
}

} // namespace pointrt

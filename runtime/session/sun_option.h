// SPDX-License-Identifier: Apache-2.0
// --sun: the sun of a time and place over a scan.
#pragma once

#include <optional>
#include <string>

#include "runtime/session/scan_frame.h"

namespace pointrt {

/// "2026-06-21T15:00-07:00@44.06,-123.07": a date and time of day, then "Z" or the offset of its zone from UTC, and the
/// place. Without an offset the zone is the one that the longitude suggests; without a place it is the scan's.
struct SunOption {
    double local_s = 0;                  ///< local time since 1970-01-01 00:00
    std::optional<double> zone_offset_s; ///< of local time from UTC, east positive
    std::optional<EarthPlace> place;
};

/// Parses all of text; throws std::invalid_argument with the reason.
SunOption parseSun(const std::string& text);

/// Sets the first sun of a scene to that time and place, or adds a sun; adds a sky if the scene has none. A scan
/// without lights is then path traced, unless an integrator is given. Throws Error kBadUsage "--sun: ..." if the place
/// is unknown or the sun is below the horizon.
void addSun(SceneDescription& scene, const SunOption& sun);

} // namespace pointrt

// SPDX-License-Identifier: Apache-2.0
// The numbers of a run as JSON: --bench and --stats.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "runtime/image/film.h"

namespace pointrt {

/// The tiles that stand for a scene's sets, and those that would, were there memory for them.
struct SetReport {
    std::uint64_t tiles = 0, bytes = 0, wanted_tiles = 0, wanted_bytes = 0, lost_tiles = 0;
};

struct Report {
    std::string device;
    std::string integrator;
    std::uint32_t width = 0, height = 0;
    std::uint32_t spp = 0;     ///< asked for, the most
    std::uint32_t samples = 0; ///< a pixel has, the fewest, with those of earlier runs
    double noise = 0;          ///< relativeNoise of the picture before denoising; JSON null where not finite
    std::uint64_t splats = 0;
    std::uint64_t device_bytes = 0;
    std::optional<SetReport> sets;    ///< where the scene has any
    double load_seconds = 0;          ///< from opening the file to ready
    double first_frame_seconds = 0;   ///< from the start of the process to the first finished frame
    std::vector<double> frame_ms;     ///< of each measured frame, at least one
    std::vector<double> frame_cpu_ms; ///< the same in time of all of this process's threads
    double denoise_ms = 0;            ///< of denoising the picture, with setting the filter up; 0: was not
    RayCounts rays;                   ///< of one frame
    std::string profile;              ///< profileJson (profile_report.h); empty: none was wanted
};

/// A JSON object with the report's fields; frame_ms and frame_cpu_ms as min, median and max, mrays_per_second of the
/// median frame (0 where no ray was traced).
std::string reportJson(const Report& report);

/// text as a JSON string, with its quotes.
std::string jsonText(const std::string& text);

/// Six digits; null where it is not finite.
std::string jsonNumber(double value);

/// A member a line; values are JSON already.
std::string jsonObject(const std::vector<std::pair<const char*, std::string>>& members);

/// Seconds since this process was started, from the kernel (in its steps of 10 ms); since the first call elsewhere.
double secondsSinceStart();

} // namespace pointrt

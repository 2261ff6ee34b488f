// SPDX-License-Identifier: Apache-2.0
// The statistics of a run as JSON, for --bench and --stats.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "runtime/image/film.h"

namespace pointrt {

/// The tiles loaded for a scene's sets, and those that full detail would need (wanted).
struct SetReport {
    std::uint64_t tiles = 0, bytes = 0, wanted_tiles = 0, wanted_bytes = 0, lost_tiles = 0;
};

struct Report {
    std::string device;
    std::string integrator;
    std::uint32_t width = 0, height = 0;
    std::uint32_t spp = 0;     ///< requested samples per pixel
    std::uint32_t samples = 0; ///< fewest samples of a pixel, including those of earlier runs
    double noise = 0;          ///< relativeNoise of the picture before denoising; null in JSON if not finite
    std::uint64_t splats = 0;
    std::uint64_t device_bytes = 0;
    std::optional<SetReport> sets;    ///< none: the scene has no tile sets
    double load_seconds = 0;          ///< from opening the file until the scene is ready to render
    double first_frame_seconds = 0;   ///< from the start of the process to the first finished frame
    std::vector<double> frame_ms;     ///< wall time of each measured frame, at least one
    std::vector<double> frame_cpu_ms; ///< CPU time of all threads for each frame
    double denoise_ms = 0;            ///< including the filter's setup; 0: not denoised
    RayCounts rays;                   ///< of one frame
    std::string profile;              ///< profileJson (profile_report.h); empty: not profiled
};

/// A JSON object with the report's fields; frame_ms and frame_cpu_ms become min, median and max. mrays_per_second
/// refers to the median frame.
std::string reportJson(const Report& report);

/// Warns of rays that ended early, if there are any.
/// @param path the picture's
void reportCutRays(const std::string& path, const RayCounts& rays);

/// text as a JSON string, with its quotes.
std::string jsonText(const std::string& text);

/// Six digits; null if value is not finite.
std::string jsonNumber(double value);

/// A JSON object with one member per line; values are JSON already.
std::string jsonObject(const std::vector<std::pair<const char*, std::string>>& members);

} // namespace pointrt

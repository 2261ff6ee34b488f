// SPDX-License-Identifier: Apache-2.0
#include "runtime/session/report.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <utility>

namespace pointrt {
namespace {

/// sorted: not empty
double median(const std::vector<double>& sorted) {
    const std::size_t half = sorted.size() / 2;
    return sorted.size() % 2 ? sorted[half] : (sorted[half - 1] + sorted[half]) / 2;
}

/// {"min": , "median": , "max": } of values, at least one.
std::string timesJson(std::vector<double> values) {
    std::sort(values.begin(), values.end());
    return "{\"min\": " + jsonNumber(values.front()) + ", \"median\": " + jsonNumber(median(values)) +
           ", \"max\": " + jsonNumber(values.back()) + "}";
}

std::string setsJson(const SetReport& sets) {
    const auto member = [](const char* name, std::uint64_t value) {
        return std::string("\"") + name + "\": " + std::to_string(value);
    };
    return "{" + member("tiles", sets.tiles) + ", " + member("bytes", sets.bytes) + ", " +
           member("wanted_tiles", sets.wanted_tiles) + ", " + member("wanted_bytes", sets.wanted_bytes) + ", " +
           member("lost_tiles", sets.lost_tiles) + "}";
}

} // namespace

std::string jsonNumber(double value) {
    if (!std::isfinite(value)) return "null";
    char text[32];
    std::snprintf(text, sizeof text, "%.6g", value);
    return text;
}

std::string jsonText(const std::string& text) {
    std::string json = "\"";
    for (char c : text) {
        if (c == '"' || c == '\\') json += '\\';
        json += static_cast<unsigned char>(c) < 0x20 ? ' ' : c;
    }
    return json + "\"";
}

std::string jsonObject(const std::vector<std::pair<const char*, std::string>>& members) {
    std::string json = "{";
    for (const auto& [name, value] : members)
        json += (json.size() > 1 ? ",\n  " : "\n  ") + jsonText(name) + ": " + value;
    return json + "\n}\n";
}

void reportCutRays(const std::string& path, const RayCounts& rays) {
    if (rays.cut == 0) return;
    std::fprintf(stderr,
                 "pointrt-view: %s: %llu rays pass through more Gaussians than this device can test, and show only "
                 "the nearest\n",
                 path.c_str(), static_cast<unsigned long long>(rays.cut));
}

std::string reportJson(const Report& report) {
    std::vector<double> sorted = report.frame_ms;
    std::sort(sorted.begin(), sorted.end());
    const double middle = median(sorted);
    const std::uint64_t all_rays = report.rays.primary + report.rays.shadow + report.rays.secondary;
    const std::string rays = "{\"primary\": " + std::to_string(report.rays.primary) +
                             ", \"shadow\": " + std::to_string(report.rays.shadow) +
                             ", \"secondary\": " + std::to_string(report.rays.secondary) + "}";
    std::vector<std::pair<const char*, std::string>> members = {
        {"device", jsonText(report.device)},
        {"width", std::to_string(report.width)},
        {"height", std::to_string(report.height)},
        {"integrator", jsonText(report.integrator)},
        {"spp", std::to_string(report.spp)},
        {"samples", std::to_string(report.samples)},
        {"noise", jsonNumber(report.noise)},
        {"splats", std::to_string(report.splats)},
        {"device_bytes", std::to_string(report.device_bytes)},
        {"load_seconds", jsonNumber(report.load_seconds)},
        {"first_frame_seconds", jsonNumber(report.first_frame_seconds)},
        {"frame_ms", timesJson(report.frame_ms)},
        {"frame_cpu_ms", timesJson(report.frame_cpu_ms)},
        {"denoise_ms", jsonNumber(report.denoise_ms)},
        {"rays", rays},
        {"mrays_per_second", jsonNumber(all_rays ? static_cast<double>(all_rays) / (1e3 * middle) : 0)}};
    if (report.sets) members.emplace_back("sets", setsJson(*report.sets));
    if (!report.profile.empty()) members.emplace_back("profile", report.profile);
    return jsonObject(members);
}

} // namespace pointrt

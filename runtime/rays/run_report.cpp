// SPDX-License-Identifier: Apache-2.0
#include "runtime/rays/run_report.h"

#include <sys/resource.h>

#include <nlohmann/json.hpp>

namespace pointrt {

std::uint64_t peakRssBytes() {
    rusage usage{};
    getrusage(RUSAGE_SELF, &usage);
    return static_cast<std::uint64_t>(usage.ru_maxrss) * 1024; // Linux reports KiB
}

std::string reportText(const std::string& device, const std::vector<std::pair<std::string, std::uint64_t>>& counts,
                       const std::vector<NamedSeconds>& seconds) {
    nlohmann::ordered_json json = {{"device", device}}, times;
    double rays = 0, cast = 0;
    for (const auto& [name, count] : counts) {
        json[name] = count;
        if (name == "rays") rays = static_cast<double>(count);
    }
    for (const auto& [name, time] : seconds) {
        times[name] = time;
        if (name == "cast") cast = time;
    }
    json["mrays_per_second"] = cast > 0 ? 1e-6 * rays / cast : 0;
    json["seconds"] = times;
    json["peak_rss_bytes"] = peakRssBytes();
    return json.dump(2, ' ', false, nlohmann::json::error_handler_t::replace) + "\n";
}

} // namespace pointrt

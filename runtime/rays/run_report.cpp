// SPDX-License-Identifier: Apache-2.0
#include "runtime/rays/run_report.h"

#include <nlohmann/json.hpp>

#include "format/os/memory.h"

namespace pointrt {

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

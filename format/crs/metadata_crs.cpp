// SPDX-License-Identifier: Apache-2.0
#include "format/crs/metadata_crs.h"

#include <nlohmann/json.hpp>

namespace pointrt {

std::string crsOfMetadata(std::string_view metadata) {
    const auto json = nlohmann::json::parse(metadata, nullptr, false);
    if (!json.is_object() || !json.contains("world") || !json["world"].is_object()) return {};
    const auto crs = json["world"].find("crs");
    return crs != json["world"].end() && crs->is_string() ? crs->get<std::string>() : std::string();
}

} // namespace pointrt

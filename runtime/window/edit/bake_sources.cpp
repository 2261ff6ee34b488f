// SPDX-License-Identifier: Apache-2.0
#include "runtime/window/edit/bake_sources.h"

#include <nlohmann/json.hpp>

namespace pointrt {

std::optional<std::vector<std::string>> bakeSources(std::string_view metadata) {
    using Json = nlohmann::json;
    const Json json = Json::parse(metadata.begin(), metadata.end(), nullptr, false);
    const auto list = json.is_object() ? json.find("sources") : json.end();
    if (list == json.end() || !list->is_array()) return std::nullopt;
    std::vector<std::string> sources;
    for (const Json& source : *list) {
        if (!source.is_string()) return std::nullopt;
        sources.push_back(source.get<std::string>());
    }
    return sources;
}

} // namespace pointrt

// SPDX-License-Identifier: Apache-2.0
#include "format/pointio/metadata.h"

namespace pointrt {

using Json = nlohmann::ordered_json;

Json parseMetadata(std::string_view text) {
    constexpr int kDepthMax = 64; // printing recurses; provenance has a depth of three or four
    if (text.empty()) return nullptr;
    bool too_deep = false;
    const auto watch_depth = [&](int depth, Json::parse_event_t, Json&) {
        too_deep |= depth > kDepthMax;
        return depth <= kDepthMax;
    };
    Json parsed = Json::parse(text.begin(), text.end(), watch_depth, false);
    if (too_deep || parsed.is_discarded()) return std::string(text);
    return parsed;
}

std::string dumpJson(const Json& json, bool ascii) { return json.dump(2, ' ', ascii, Json::error_handler_t::replace); }

} // namespace pointrt

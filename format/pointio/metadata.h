// SPDX-License-Identifier: Apache-2.0
// The META section as JSON, whatever its bytes are.
#pragma once

#include <nlohmann/json.hpp>
#include <string_view>

namespace pointrt {

/// Null for no text; a string where the text is not JSON or nests deeper than can be printed safely.
nlohmann::ordered_json parseMetadata(std::string_view text);

/// Bytes that are not UTF-8 are replaced. @param ascii escapes all else, so that no terminal acts on it
std::string dumpJson(const nlohmann::ordered_json& json, bool ascii);

} // namespace pointrt

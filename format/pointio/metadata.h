// SPDX-License-Identifier: Apache-2.0
// The META section as JSON, tolerating any bytes.
#pragma once

#include <nlohmann/json.hpp>
#include <string_view>

namespace pointrt {

/// Null for an empty text; a string if the text is not JSON or nests too deeply to print.
nlohmann::ordered_json parseMetadata(std::string_view text);

/// Replaces bytes that are not UTF-8.
/// @param ascii escape other characters, so that terminals do not interpret them
std::string dumpJson(const nlohmann::ordered_json& json, bool ascii);

} // namespace pointrt

// SPDX-License-Identifier: Apache-2.0
// A summary for people, and for programs.
#pragma once

#include <string>
#include <string_view>

#include "format/info/summary.h"

namespace pointrt {

/// Several lines; lengths are marked as input units. Free to change between versions.
std::string summaryText(const std::string& path, const Summary& summary, const ProFile& file);

/// One JSON object; keys keep their meaning. Metadata that is not JSON becomes a string.
std::string summaryJson(const Summary& summary, const ProFile& file);

} // namespace pointrt

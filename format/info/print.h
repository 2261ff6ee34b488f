// SPDX-License-Identifier: Apache-2.0
// The summary of a file as text and as JSON.
#pragma once

#include <string>
#include <string_view>

#include "format/info/summary.h"

namespace pointrt {

/// Several lines, with lengths in input units. The text may change between versions.
std::string summaryText(const std::string& path, const Summary& summary, const ProFile& file);

/// One JSON object; its keys are stable. Metadata that is not JSON becomes a string.
std::string summaryJson(const Summary& summary, const ProFile& file);

} // namespace pointrt

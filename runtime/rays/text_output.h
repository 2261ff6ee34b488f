// SPDX-License-Identifier: Apache-2.0
// Outputs of commands that print their results and optionally write them to a file.
#pragma once

#include <initializer_list>
#include <string>
#include <string_view>

#include "runtime/rays/common_options.h"

namespace pointrt {

/// Throws Error kBadUsage if -o has none of these suffixes, or --stats would mix with the results on standard output;
/// kCannotWrite if -o or --stats cannot be written.
void checkTextOutput(const CommonOptions& options, std::initializer_list<std::string_view> suffixes);

} // namespace pointrt

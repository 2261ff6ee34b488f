// SPDX-License-Identifier: GPL-3.0-or-later
// Outputs must not overwrite inputs.
#pragma once

#include <string>

#include "preprocess/app/options.h"

namespace pointrt {

/// Throws Error (kBadUsage) if path, given by option, is an input.
void requireNoInput(const BakeOptions& options, const std::string& path, const char* option);

/// Throws Error if the report cannot be written or would overwrite a scan or the output.
void checkStats(const BakeOptions& options);

} // namespace pointrt

// SPDX-License-Identifier: Apache-2.0
// A run of a command that draws lines.
#pragma once

#include <cstdint>
#include <string>

#include "runtime/rays/common_options.h"

namespace pointrt {

struct LineRun {
    std::string device;
    std::uint64_t lines = 0;
    double open_s = 0, cast_s = 0, write_s = 0, total_s = 0;
};

/// Prints the lines of -v, and writes the report of --stats.
void reportRun(const CommonOptions& options, const LineRun& run);

} // namespace pointrt

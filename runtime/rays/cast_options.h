// SPDX-License-Identifier: Apache-2.0
// The command line of pointrt-rays cast.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "format/cli/command_text.h"
#include "pointrt/trace.hpp"
#include "runtime/rays/common_options.h"

namespace pointrt {

struct CastOptions : CommonOptions {
    std::string rays;                    ///< a file, or "-"
    bool any = false;                    ///< only whether anything is hit
    std::vector<std::string> attributes; ///< names
    RayLimits limits;
};

/// Fills options from the words behind "cast". Returns an exit code where the run ends here (--help and --version).
/// Throws Error kBadUsage with one line for anything wrong.
std::optional<int> parseCastOptions(int argc, const char* const* argv, CastOptions& options);

/// What --help says, as data.
CommandText castText();

} // namespace pointrt

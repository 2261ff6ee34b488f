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
    std::string rays;                    ///< path of a file, or "-"
    bool any = false;                    ///< occlusion only
    std::vector<std::string> attributes; ///< names
    RayLimits limits;
};

/// Parses the arguments after "cast". Returns an exit code if the run ends here (--help, --version). Throws Error
/// kBadUsage with a one-line message for invalid arguments.
std::optional<int> parseCastOptions(int argc, const char* const* argv, CastOptions& options);

/// The text of --help, as data.
CommandText castText();

} // namespace pointrt

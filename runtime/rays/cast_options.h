// SPDX-License-Identifier: Apache-2.0
// The command line of pointrt-rays cast.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "pointrt/trace.hpp"

namespace pointrt {

struct CastOptions {
    std::vector<std::string> scene;      ///< .pro files
    std::string rays;                    ///< a file, or "-"
    std::string output;                  ///< a file, or "-"
    bool any = false;                    ///< only whether anything is hit
    std::vector<std::string> attributes; ///< names
    RayLimits limits;
    std::string device; ///< a selector, see DeviceRequest
    std::string stats;  ///< file for the report, "-" for standard output, empty for none
    bool quiet = false, verbose = false;
};

/// Fills options from the words behind "cast". Returns an exit code where the run ends here (--help and --version).
/// Throws Error kBadUsage with one line for anything wrong.
std::optional<int> parseCastOptions(int argc, const char* const* argv, CastOptions& options);

/// What pointrt-rays --help prints, where no command is named.
std::string raysHelp();

} // namespace pointrt

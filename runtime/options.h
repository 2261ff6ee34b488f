// SPDX-License-Identifier: Apache-2.0
// The command line of pointrt-view.
#pragma once

#include <optional>
#include <string>

#include "runtime/render.h"

namespace pointrt {

struct Options {
    std::string scene;
    std::string output; ///< ends in .png or .exr; empty with bench_frames or list_devices
    std::string device; ///< a selector, see DeviceRequest
    std::string stats;  ///< file for the report, "-" for standard output, empty for none
    RenderSettings render;
    std::uint32_t bench_frames = 0; ///< 0: no benchmark
    bool list_devices = false;
    bool quiet = false, verbose = false;
};

/// Fills options from the command line. Returns an exit code where the run ends here (--help and --version, whose text
/// goes to standard output). Throws Error kBadUsage with one line for anything wrong.
std::optional<int> parseOptions(int argc, const char* const* argv, Options& options);

/// "X,Y,Z" as three finite numbers. Throws std::invalid_argument with the reason.
Vec3 parseVector(const std::string& text);

} // namespace pointrt

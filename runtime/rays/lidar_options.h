// SPDX-License-Identifier: Apache-2.0
// The command line of pointrt-rays lidar.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "format/cli/command_text.h"
#include "runtime/rays/common_options.h"

namespace pointrt {

struct LidarOptions : CommonOptions {
    std::string sensor;       ///< a sensor file
    std::string trajectory;   ///< a file, or empty
    std::vector<double> pose; ///< x, y, z; or x, y, z, yaw, pitch, roll with angles in degrees; or empty
    std::optional<double> start_s, duration_s;
    double metres_per_unit = 0; ///< 0: the scans' own
    std::uint64_t seed = 0;
    std::vector<std::string> attributes; ///< names
};

/// Parses the arguments after "lidar". Returns an exit code if the run ends here (--help, --version). Throws Error
/// kBadUsage with a one-line message for invalid arguments.
std::optional<int> parseLidarOptions(int argc, const char* const* argv, LidarOptions& options);

/// The text of --help, as data.
CommandText lidarText();

} // namespace pointrt

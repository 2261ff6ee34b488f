// SPDX-License-Identifier: Apache-2.0
// Options that each command takes.
#pragma once

#include <string>
#include <vector>

#include "pointrt/trace.hpp"

namespace CLI {
class App;
}

namespace pointrt {

struct CommonOptions {
    std::vector<std::string> scene; ///< .pro files, tile sets, scene files
    SceneOptions held;
    std::string output; ///< a file, or "-"
    std::string device; ///< a selector, see DeviceRequest
    std::string stats;  ///< file for the report, "-" for standard output, empty for none
    bool quiet = false, verbose = false;
};

/// SCENE, and -o with this help.
void addSceneAndOutput(CLI::App& app, CommonOptions& options, const std::string& output_help);
/// --memory, --device, --stats, -q, -v.
void addDeviceAndReport(CLI::App& app, CommonOptions& options);

/// Throws Error kBadUsage where options exclude each other, standard output is asked for twice or is a terminal, or an
/// output is an input.
/// @param inputs files besides the scene's; "-" is none
/// @param what of the output, for messages: "hits"
void checkCommonOptions(const CommonOptions& options, std::vector<std::string> inputs, const std::string& what);

} // namespace pointrt

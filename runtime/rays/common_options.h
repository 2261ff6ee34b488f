// SPDX-License-Identifier: Apache-2.0
// Options that each command takes.
#pragma once

#include <string>
#include <vector>

#include "pointrt/trace.hpp"

namespace pointrt {

struct CommandLine;

struct CommonOptions {
    std::vector<std::string> scene; ///< .pro files, tile sets, scene files
    SceneOptions held;
    std::string output; ///< a file, or "-"
    std::string device; ///< a selector, see DeviceRequest
    std::string stats;  ///< file for the report, "-" for standard output, empty for none
    bool quiet = false, verbose = false;
};

/// What exit code 1 says.
inline constexpr const char* kWrongInput = "an input is wrong";

/// SCENE, and -o with this help and these suffixes, blanks between them.
void addSceneAndOutput(CommandLine& app, CommonOptions& options, const std::string& output_help,
                       const std::string& suffixes);
/// --memory, --device, --stats, -q, -v.
void addDeviceAndReport(CommandLine& app, CommonOptions& options);

/// Throws Error kBadUsage where options exclude each other, standard output is asked for twice or is a terminal, or an
/// output is an input.
/// @param inputs files besides the scene's; "-" is none
/// @param what of the output, for messages: "hits"
void checkCommonOptions(const CommonOptions& options, std::vector<std::string> inputs, const std::string& what);

} // namespace pointrt

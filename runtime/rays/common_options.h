// SPDX-License-Identifier: Apache-2.0
// Options of every command.
#pragma once

#include <string>
#include <vector>

#include "pointrt/trace.hpp"

namespace pointrt {

struct CommandLine;

struct CommonOptions {
    std::vector<std::string> scene; ///< .pro files, tile sets, scene files
    SceneOptions scene_options;
    std::string output; ///< a file, or "-"
    std::string device; ///< a selector, see DeviceRequest
    std::string stats;  ///< file for the report, "-" for standard output, empty for none
    bool quiet = false, verbose = false;
};

/// The meaning of exit code 1 in --help.
inline constexpr const char* kWrongInput = "an input cannot be read or is malformed";

/// Adds SCENE, one or several.
void addScene(CommandLine& app, CommonOptions& options);
/// Adds -o.
/// @param suffixes of output files, separated by spaces
void addOutput(CommandLine& app, CommonOptions& options, const std::string& help, const std::string& suffixes,
               bool required = true);
/// Adds --memory, --device, --stats, -q, -v.
void addDeviceAndReport(CommandLine& app, CommonOptions& options);

/// Throws Error kBadUsage if options cannot be combined, two outputs go to standard output, standard output is a
/// terminal, or an output is an input.
/// @param inputs files besides the scene's; "-" is ignored
/// @param what is written, for messages: "hits"
void checkCommonOptions(const CommonOptions& options, std::vector<std::string> inputs, const std::string& what);

/// Prints a line to standard error unless options.quiet.
void printNote(const CommonOptions& options, const std::string& line);

} // namespace pointrt

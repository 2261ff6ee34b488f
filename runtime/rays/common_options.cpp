// SPDX-License-Identifier: Apache-2.0
#include "runtime/rays/common_options.h"

#include <cstdio>

#include "format/base/error.h"
#include "format/base/same_file.h"
#include "format/cli/command_line.h"
#include "format/os/descriptor.h"
#include "format/os/terminal.h"
#include "runtime/util/parse.h"

namespace pointrt {
namespace {

[[noreturn]] void refuseUsage(const std::string& text) { throw Error(ExitCode::kBadUsage, text); }

std::uint64_t bytesOf(const std::string& text) {
    try {
        return parseBytes(text);
    } catch (const std::invalid_argument& reason) {
        refuseUsage(std::string("--memory: ") + reason.what());
    }
}

std::array<double, 6> boxOf(const std::string& text) {
    try {
        return parseBox(text);
    } catch (const std::invalid_argument& reason) {
        refuseUsage(std::string("--clip: ") + reason.what());
    }
}

void checkStandardOutput(const CommonOptions& options, const std::string& what) {
    if (options.output != "-") return;
    if (options.stats == "-") refuseUsage("-o - and --stats - cannot be combined: both write to standard output");
    if (isTerminal(kStandardOutput))
        refuseUsage("-o -: standard output is a terminal; redirect the " + what + " to a file or a pipe");
}

} // namespace

void addScene(CommandLine& app, CommonOptions& options) {
    app.option_defaults()->multi_option_policy(CLI::MultiOptionPolicy::TakeLast);
    app.add_option("SCENE", options.scene,
                   "A .pro file, tile set (.proset) or scene file (.toml). instance_ids are the indices, from 0, of "
                   "these files or of a scene file's instances")
        ->required()
        ->type_name("")
        ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll);
    completes(app, "SCENE", ".pro .proset .toml");
}

void addOutput(CommandLine& app, CommonOptions& options, const std::string& help, const std::string& suffixes,
               bool required) {
    app.add_option("-o,--output", options.output, help)->required(required)->type_name("FILE");
    completes(app, "--output", suffixes);
}

void addDeviceAndReport(CommandLine& app, CommonOptions& options) {
    app.add_option_function<std::vector<std::string>>(
           "--clip",
           [&options](const std::vector<std::string>& texts) {
               for (const std::string& text : texts) options.scene_options.clips.push_back(boxOf(text));
           },
           "Let rays hit only the parts of scans inside this box, in the scans' coordinates. Several boxes: only what "
           "is inside all of them. Shapes are not clipped (default: no clipping)")
        ->type_name("MINX,MINY,MINZ,MAXX,MAXY,MAXZ")
        ->allow_extra_args(false)
        ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll);
    app.add_option("--only", options.scene_options.filters,
                   "Let rays hit only points whose attribute has one of these values, e.g. class=2,6, or lies in this "
                   "range, e.g. height=10:25. Several filters: only points that match all of them (default: no filter)")
        ->type_name("NAME=VALUES")
        ->allow_extra_args(false)
        ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll);
    app.add_option_function<std::string>(
           "--memory", [&options](const std::string& text) { options.scene_options.memory = bytesOf(text); },
           "Memory limit for the tiles of sets, e.g. 4G or 500M (default 2G); a smaller limit reloads tiles more "
           "often, but gives the same results")
        ->type_name("SIZE");
    app.add_option("--device", options.device,
                   "Vulkan device, by number or part of its name (default: a discrete GPU, else an integrated one, "
                   "else a CPU driver); list them with pointrt-view --device list")
        ->type_name("DEVICE");
    app.add_option("--stats", options.stats,
                   "Write a JSON report of the run; - is standard output, for commands that print no results there")
        ->type_name("FILE");
    completes(app, "--stats", ".json");
    app.add_flag("-q,--quiet", options.quiet, "Print errors only");
    app.add_flag("-v,--verbose", options.verbose, "Print what was done and how fast");
}

void checkCommonOptions(const CommonOptions& options, std::vector<std::string> inputs, const std::string& what) {
    if (options.quiet && options.verbose) refuseUsage("-q and -v cannot be combined");
    checkStandardOutput(options, what);
    inputs.insert(inputs.end(), options.scene.begin(), options.scene.end());
    for (const std::string& input : inputs)
        for (const std::string& output : {options.output, options.stats})
            if (input != "-" && output != "-" && !output.empty() && isSameFile(input, output))
                refuseUsage(output + ": is an input");
    if (!options.stats.empty() && options.stats != "-" && isSameFile(options.stats, options.output))
        refuseUsage(options.stats + ": is the output");
}

void printNote(const CommonOptions& options, const std::string& line) {
    if (!options.quiet) std::fprintf(stderr, "%s\n", line.c_str());
}

} // namespace pointrt

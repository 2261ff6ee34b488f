// SPDX-License-Identifier: Apache-2.0
#include "runtime/session/output_check.h"

#include <string>
#include <vector>

#include "format/base/error.h"
#include "format/base/same_file.h"
#include "format/os/descriptor.h"
#include "format/os/terminal.h"

namespace pointrt {
namespace {

struct NamedOutput {
    const char* option;
    const std::string& path;
};

[[noreturn]] void refuse(const std::string& reason) { throw Error{ExitCode::kBadUsage, reason}; }

std::vector<std::string> filesOf(const Options& options, const SceneDescription& scene) {
    std::vector<std::string> files = options.inputs;
    for (const InstanceDescription& instance : scene.instances) files.push_back(instance.path);
    if (scene.sky && !scene.sky->image.empty()) files.push_back(scene.sky->image);
    if (!options.replay.empty()) files.push_back(options.replay);
    return files;
}

} // namespace

void requireOutputsApart(const Options& options, const SceneDescription& scene) {
    if (options.output == "-" && isTerminal(kStandardOutput))
        refuse("-o -: standard output is a terminal; redirect the picture to a file or a pipe");
    const NamedOutput outputs[] = {{"-o", options.video.empty() ? options.output : options.video},
                                   {"--stats", options.stats},
                                   {"--record", options.record}};
    const std::vector<std::string> inputs = filesOf(options, scene);
    for (const NamedOutput& output : outputs) {
        if (output.path.empty() || output.path == "-") continue;
        for (const std::string& input : inputs)
            if (isSameFile(output.path, input))
                refuse(output.path + ": " + output.option + " would overwrite an input of the scene");
        for (const NamedOutput& other : outputs)
            if (&other != &output && !other.path.empty() && isSameFile(output.path, other.path))
                refuse(output.path + ": " + output.option + " and " + other.option + " are the same file");
    }
}

} // namespace pointrt

// SPDX-License-Identifier: Apache-2.0
#include "runtime/window/edit/viewer_run.h"

#include <cstdio>

#include "format/base/error.h"
#include "format/os/program.h"
#include "runtime/session/tool_run.h"
#include "runtime/window/edit/temporary_scene.h"

namespace pointrt {
namespace {

/// Parses "progress SHARE DETAIL" of pointrt-view --progress lines.
bool parseProgress(const std::string& line, JobControl& control) {
    double share = 0;
    int detail = 0;
    if (std::sscanf(line.c_str(), "progress %lf %n", &share, &detail) != 1 || detail == 0) return false;
    control.setProgress(share);
    control.setDetail(line.substr(static_cast<std::size_t>(detail)));
    return true;
}

} // namespace

void runViewer(const SceneDescription& scene, const std::vector<std::string>& options, const std::string& device,
               JobControl& control) {
    const TemporaryScenes scenes;
    std::vector<std::string> arguments{programPath(), scenes.write("scene", scene), "--progress", "lines"};
    arguments.insert(arguments.end(), options.begin(), options.end());
    if (!device.empty()) arguments.insert(arguments.end(), {"--device", device});
    const ToolResult end = runTool(
        arguments, "pointrt-view", [&] { return control.cancelled(); },
        [&](const std::string& line) { return parseProgress(line, control); });
    control.throwIfCancelled();
    if (end.wait_status != 0) throw Error{ExitCode::kCannotRun, describeFailure(end, "pointrt-view")};
}

} // namespace pointrt

// SPDX-License-Identifier: Apache-2.0
#include "runtime/window/edit/rays_run.h"

#include <cstdio>

#include "format/base/error.h"
#include "runtime/session/find_tool.h"
#include "runtime/session/tool_run.h"

namespace pointrt {
namespace {

/// Parses "Tracing 40%, ..." of a verbose run.
bool parseTenths(const std::string& line, JobControl& control) {
    int percent = 0;
    if (std::sscanf(line.c_str(), "%*[A-Za-z] %d%%,", &percent) != 1) return false;
    control.setProgress(percent / 100.0);
    return true;
}

} // namespace

InstanceDescription bareScan(InstanceDescription scan) {
    scan.material.reset();
    scan.overrides.clear();
    return scan;
}

void runRays(const std::string& tool, const std::string& command, const std::vector<std::string>& arguments,
             const std::string& device, JobControl& control) {
    const std::string name = std::string(kRaysTool) + " " + command;
    std::vector<std::string> all{tool, command};
    all.insert(all.end(), arguments.begin(), arguments.end());
    if (!device.empty()) all.insert(all.end(), {"--device", device});
    const ToolResult end = runTool(
        all, name, [&] { return control.cancelled(); },
        [&](const std::string& line) { return parseTenths(line, control); });
    control.throwIfCancelled();
    if (end.wait_status != 0) throw Error{exitCodeOf(end), describeFailure(end, name)};
}

} // namespace pointrt

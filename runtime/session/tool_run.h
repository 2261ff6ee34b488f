// SPDX-License-Identifier: Apache-2.0
// Runs another pointrt tool.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "format/base/error.h"

namespace pointrt {

struct ToolResult {
    int wait_status = 0;   ///< of ChildProcess
    std::string last_line; ///< the last line of output that was not progress, without the tool's name
};

/// Runs arguments[0], the path of the tool called name, to its end. Passes each line of output to on_line, which
/// returns whether it was progress. Once cancelled() is true, the tool gets SIGTERM, and SIGKILL after three seconds.
/// Throws Error as ChildProcess does.
ToolResult runTool(const std::vector<std::string>& arguments, const std::string& name,
                   const std::function<bool()>& cancelled, const std::function<bool(const std::string& line)>& on_line);

/// Why the tool called name failed, in its own words if it printed a reason.
std::string describeFailure(const ToolResult& end, const std::string& name);

/// The tool's exit status as an exit code; kCannotRun if it is not one of ours.
ExitCode exitCodeOf(const ToolResult& end);

/// Prefixes a path so that it cannot be taken for an option.
std::string safeArgument(const std::string& path);

} // namespace pointrt

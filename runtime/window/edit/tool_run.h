// SPDX-License-Identifier: Apache-2.0
// Another tool of ours at work for a job.
#pragma once

#include <sys/types.h>

#include <functional>
#include <string>
#include <vector>

#include "runtime/window/edit/job.h"

namespace pointrt {

struct ToolResult {
    int wait_status = 0;   ///< as waitpid has it
    pid_t id = 0;          ///< of the process there was
    std::string last_line; ///< of what it said, without its name and progress
};

/// Runs arguments[0], the path of the tool called name, to its end; each line that it writes goes to tell, which says
/// whether it was progress. Cancelled, the tool is asked to end (SIGTERM) and made to after three seconds. Throws Error
/// as ChildProcess does.
ToolResult runTool(const std::vector<std::string>& arguments, const std::string& name, const JobControl& control,
                   const std::function<bool(const std::string& line)>& on_line);

/// Why a tool called name that ended so has failed, in its own words where it has left any.
std::string describeFailure(const ToolResult& end, const std::string& name);

/// What a tool of ours says by its exit status, kCannotRun where it says nothing.
ExitCode exitCodeOf(const ToolResult& end);

/// So that no program takes a path for an option or a list.
std::string safeArgument(const std::string& path);

} // namespace pointrt

// SPDX-License-Identifier: Apache-2.0
// The exit codes by which a tool's process reports its end to the system.
#pragma once

namespace pointrt {

/// Exit codes of all tools.
enum class ExitCode { kDone = 0, kBadInput = 1, kBadUsage = 2, kCannotRun = 3, kCannotWrite = 4 };

} // namespace pointrt

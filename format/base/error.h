// SPDX-License-Identifier: Apache-2.0
// Errors of the command line tools: one line and an exit code.
#pragma once

#include <stdexcept>
#include <string>

#include "format/os/exit_code.h"
#include "pointrt/pro.h"

namespace pointrt {

/// Thrown anywhere, caught in runTool. what() is "FILE[:PLACE]: reason" without the name of the tool.
struct Error : std::runtime_error {
    ExitCode code;
    Error(ExitCode exit_code, const std::string& message) : std::runtime_error(message), code(exit_code) {}
};

/// The exit code for a result of the format library.
inline ExitCode exitCodeOf(pro_result result) {
    switch (result) {
    case PRO_OK:
        return ExitCode::kDone;
    case PRO_CANNOT_READ:
    case PRO_INVALID:
    case PRO_UNSUPPORTED:
        return ExitCode::kBadInput;
    case PRO_CANNOT_WRITE:
        return ExitCode::kCannotWrite;
    case PRO_OUT_OF_MEMORY:
    case PRO_BAD_ARGUMENT:
        break;
    }
    return ExitCode::kCannotRun;
}

} // namespace pointrt

// SPDX-License-Identifier: Apache-2.0
// Turns the exceptions of a tool into an error line and an exit code.
#pragma once

#include <cstdio>
#include <exception>
#include <new>
#include <string>

#include "format/base/error.h"
#include "format/base/printable.h"
#include "format/os/process.h"
#include "pointrt/pro.hpp"

namespace pointrt {

/// Runs body() -> int; exceptions become one line on stderr and an exit code.
template <typename Body>
int runTool(const char* tool_name, Body&& body) {
    prepareProcess(tool_name);
    auto fail = [&](const char* reason, ExitCode code) {
        std::fflush(stdout);
        std::fprintf(stderr, "%s: error: %s\n", tool_name, printable(reason, std::string::npos).c_str());
        return static_cast<int>(code);
    };
    try {
        return body();
    } catch (const Error& error) {
        const char* advice = error.code == ExitCode::kBadUsage ? " (see --help)" : "";
        return fail((error.what() + std::string(advice)).c_str(), error.code);
    } catch (const ProError& error) {
        return fail(error.what(), exitCodeOf(error.result));
    } catch (const std::bad_alloc&) {
        return fail("out of memory", ExitCode::kCannotRun);
    } catch (const std::exception& error) {
        return fail(error.what(), ExitCode::kCannotRun);
    }
}

} // namespace pointrt

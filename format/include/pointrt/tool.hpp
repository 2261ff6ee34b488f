// SPDX-License-Identifier: Apache-2.0
// What the three command-line tools share: exit codes and one way to fail.
#pragma once

#include <cstdio>
#include <exception>
#include <new>
#include <stdexcept>
#include <string>

namespace pointrt {

/// Exit codes of pointrt-bake, pointrt-view and pointrt-info.
enum class ExitCode { kDone = 0, kBadInput = 1, kBadUsage = 2, kCannotRun = 3, kCannotWrite = 4 };

/// Thrown anywhere, caught once in runTool. what() is "FILE[:PLACE]: reason", without the tool's name.
struct Error : std::runtime_error {
    ExitCode code;
    Error(ExitCode exit_code, const std::string& message) : std::runtime_error(message), code(exit_code) {}
};

/// Runs body() -> int and turns exceptions into the one-line errors and exit codes of the contract.
template <typename Body>
int runTool(const char* tool_name, Body&& body) {
    auto fail = [&](const char* reason, ExitCode code) {
        std::fflush(stdout);
        std::fprintf(stderr, "%s: error: %s\n", tool_name, reason);
        return static_cast<int>(code);
    };
    try {
        return body();
    } catch (const Error& error) {
        return fail(error.what(), error.code);
    } catch (const std::bad_alloc&) {
        return fail("out of memory", ExitCode::kCannotRun);
    } catch (const std::exception& error) {
        return fail(error.what(), ExitCode::kCannotRun);
    }
}

} // namespace pointrt

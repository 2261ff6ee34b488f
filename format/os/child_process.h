// SPDX-License-Identifier: Apache-2.0
// A child process and its output.
#pragma once

#include <chrono>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace pointrt {

/// A child process, killed by the destructor if it is still running.
class ChildProcess {
public:
    /// Runs arguments[0], a path, with these arguments, without a shell, so they may contain any byte but 0. Its
    /// standard input is empty; its standard output and error are read here. Throws std::system_error "PATH: cannot
    /// start: reason".
    explicit ChildProcess(const std::vector<std::string>& arguments);
    ~ChildProcess();
    ChildProcess(const ChildProcess&) = delete;
    ChildProcess& operator=(const ChildProcess&) = delete;

    /// Returns new output, waiting until the timeout; "" if nothing was written. After the end of the output, only
    /// sleeps.
    std::string read(std::chrono::milliseconds timeout);
    /// Once the process has ended: its status, as the system encodes it. 0 is success.
    std::optional<int> waitStatus();
    /// Asks the process to end (SIGTERM); on Windows, kills it.
    void terminate();
    /// Kills the process (SIGKILL).
    void kill();
    /// The process identifier; on Windows a HANDLE.
    std::intptr_t id() const { return process_; }

private:
    std::intptr_t process_ = -1; ///< its identifier, or a HANDLE of Windows
    std::intptr_t output_ = -1;  ///< the end of a pipe: a descriptor, or a HANDLE
    std::optional<int> status_;
};

/// The exit code of a process that ended by itself.
std::optional<int> exitStatusOf(int wait_status);

/// "ended with status 3", "was killed by signal 9 (Killed)".
std::string describeExit(int wait_status);

} // namespace pointrt

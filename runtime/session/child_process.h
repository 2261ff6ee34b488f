// SPDX-License-Identifier: Apache-2.0
// A child process and its output.
#pragma once

#include <sys/types.h>

#include <chrono>
#include <optional>
#include <string>
#include <vector>

namespace pointrt {

/// The destructor kills it (SIGKILL) if it is still running.
class ChildProcess {
public:
    /// Runs arguments[0], a path, with these arguments, without a shell, so they may contain any byte but 0. Its
    /// standard input is empty; its standard output and error are read here. Throws Error kCannotRun "PATH: reason".
    explicit ChildProcess(const std::vector<std::string>& arguments);
    ~ChildProcess();
    ChildProcess(const ChildProcess&) = delete;
    ChildProcess& operator=(const ChildProcess&) = delete;

    /// Returns new output, waiting until the timeout; "" if nothing was written. After the end of the output it just
    /// sleeps.
    std::string read(std::chrono::milliseconds timeout);
    /// The status of waitpid, once the process has ended.
    std::optional<int> waitStatus();
    void signal(int number);
    pid_t id() const { return id_; }

private:
    pid_t id_ = -1;
    int output_ = -1;
    std::optional<int> status_;
};

/// "ended with status 3", "was killed by signal 9 (Killed)".
std::string describeExit(int wait_status);

} // namespace pointrt

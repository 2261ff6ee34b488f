// SPDX-License-Identifier: Apache-2.0
// Another program at work, and what it says.
#pragma once

#include <sys/types.h>

#include <chrono>
#include <optional>
#include <string>
#include <vector>

namespace pointrt {

/// A program that was started. Whoever destroys it while it runs ends it at once (SIGKILL).
class ChildProcess {
public:
    /// Starts arguments[0], a path, with these arguments, without a shell: any bytes but 0 may be in them. It reads
    /// nothing; what it writes to standard output and error is read here. Throws Error kCannotRun "PATH: reason".
    explicit ChildProcess(const std::vector<std::string>& arguments);
    ~ChildProcess();
    ChildProcess(const ChildProcess&) = delete;
    ChildProcess& operator=(const ChildProcess&) = delete;

    /// What it has written, of which some is waited for up to patience; "" where there is none. It sleeps for patience
    /// where nothing more can come.
    std::string read(std::chrono::milliseconds timeout);
    /// The status of waitpid once it has ended.
    std::optional<int> waitStatus();
    void signal(int number);
    pid_t id() const { return id_; }

private:
    pid_t id_ = -1;
    int output_ = -1;
    std::optional<int> status_;
};

/// "ended with status 3", "was ended by signal 9 (Killed)".
std::string describeExit(int wait_status);

} // namespace pointrt

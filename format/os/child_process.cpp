// SPDX-License-Identifier: Apache-2.0
#include "format/os/child_process.h"

#include <fcntl.h>
#include <poll.h>
#include <signal.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <cstring>
#include <system_error>
#include <thread>

extern char** environ;

namespace pointrt {
namespace {

/// Owns posix_spawn's file actions and attributes.
struct SpawnPlan {
    posix_spawn_file_actions_t files;
    posix_spawnattr_t attributes;

    explicit SpawnPlan(int output) {
        posix_spawn_file_actions_init(&files);
        posix_spawn_file_actions_addopen(&files, STDIN_FILENO, "/dev/null", O_RDONLY, 0);
        posix_spawn_file_actions_adddup2(&files, output, STDOUT_FILENO);
        posix_spawn_file_actions_adddup2(&files, output, STDERR_FILENO);
        // this thread may block signals, which the child must not inherit
        sigset_t none;
        sigemptyset(&none);
        posix_spawnattr_init(&attributes);
        posix_spawnattr_setsigmask(&attributes, &none);
        posix_spawnattr_setflags(&attributes, POSIX_SPAWN_SETSIGMASK);
    }
    ~SpawnPlan() {
        posix_spawn_file_actions_destroy(&files);
        posix_spawnattr_destroy(&attributes);
    }
    SpawnPlan(const SpawnPlan&) = delete;
    SpawnPlan& operator=(const SpawnPlan&) = delete;
};

int spawn(pid_t& id, const std::vector<std::string>& arguments, int output) {
    std::vector<char*> words;
    for (const std::string& argument : arguments) words.push_back(const_cast<char*>(argument.c_str()));
    words.push_back(nullptr);
    const SpawnPlan plan(output);
    return posix_spawn(&id, words[0], &plan.files, &plan.attributes, words.data(), environ);
}

} // namespace

ChildProcess::ChildProcess(const std::vector<std::string>& arguments) {
    std::array<int, 2> pipe_ends{};
    const auto fail = [&](int error) {
        throw std::system_error(error, std::generic_category(), arguments.front() + ": cannot start");
    };
    if (pipe2(pipe_ends.data(), O_CLOEXEC) != 0) fail(errno);
    pid_t id = -1;
    const int error = spawn(id, arguments, pipe_ends[1]);
    close(pipe_ends[1]);
    if (error != 0) {
        close(pipe_ends[0]);
        fail(error);
    }
    process_ = id;
    output_ = pipe_ends[0];
    // grandchildren may keep the pipe open after the child has ended
    fcntl(pipe_ends[0], F_SETFL, O_NONBLOCK);
}

ChildProcess::~ChildProcess() {
    if (!waitStatus()) {
        kill();
        while (waitpid(static_cast<pid_t>(process_), nullptr, 0) < 0 && errno == EINTR) {
        }
    }
    if (output_ >= 0) close(static_cast<int>(output_));
}

std::string ChildProcess::read(std::chrono::milliseconds timeout) {
    if (output_ < 0) {
        std::this_thread::sleep_for(timeout);
        return {};
    }
    const auto descriptor = static_cast<int>(output_);
    pollfd wait{descriptor, POLLIN, 0};
    if (poll(&wait, 1, static_cast<int>(timeout.count())) <= 0) return {};
    std::array<char, 4096> bytes;
    const ssize_t count = ::read(descriptor, bytes.data(), bytes.size());
    if (count > 0) return {bytes.data(), static_cast<std::size_t>(count)};
    if (count == 0 || (errno != EAGAIN && errno != EINTR)) {
        close(descriptor);
        output_ = -1;
    }
    return {};
}

std::optional<int> ChildProcess::waitStatus() {
    int status = 0;
    if (!status_ && waitpid(static_cast<pid_t>(process_), &status, WNOHANG) == process_) status_ = status;
    return status_;
}

void ChildProcess::terminate() {
    if (!waitStatus()) ::kill(static_cast<pid_t>(process_), SIGTERM);
}

void ChildProcess::kill() {
    if (!waitStatus()) ::kill(static_cast<pid_t>(process_), SIGKILL);
}

std::optional<int> exitStatusOf(int wait_status) {
    if (WIFEXITED(wait_status)) return WEXITSTATUS(wait_status);
    return {};
}

std::string describeExit(int wait_status) {
    if (const auto code = exitStatusOf(wait_status)) return "ended with status " + std::to_string(*code);
    const int number = WTERMSIG(wait_status);
    return "was killed by signal " + std::to_string(number) + " (" + strsignal(number) + ")";
}

} // namespace pointrt

// SPDX-License-Identifier: Apache-2.0
#include "runtime/session/tool_run.h"

#include <memory>
#include <optional>
#include <system_error>

#include "format/os/child_process.h"

namespace pointrt {
namespace {

using Clock = std::chrono::steady_clock;

/// Longest time until a cancelled tool gets SIGTERM, and the time that the tool then has to exit.
constexpr std::chrono::milliseconds kPoll{50};
constexpr std::chrono::seconds kGrace{3};
/// Longer lines are truncated.
constexpr std::size_t kLongestLine = 4096;

/// Splits output into lines; keeps the last one that is not progress.
class OutputReader {
public:
    explicit OutputReader(const std::function<bool(const std::string&)>& on_line) : on_line_(on_line) {}

    void append(const std::string& bytes) {
        for (const char c : bytes) {
            if (c != '\n') {
                if (line_.size() < kLongestLine) line_ += c;
                continue;
            }
            if (!line_.empty() && !on_line_(line_)) last_ = line_;
            line_.clear();
        }
    }

    /// Without the tool's name. A last line without a line feed counts, too.
    std::string lastLine(const std::string& name) const {
        const std::string prefix = name + ": error: ", line = line_.empty() ? last_ : line_;
        return line.starts_with(prefix) ? line.substr(prefix.size()) : line;
    }

private:
    const std::function<bool(const std::string&)>& on_line_;
    std::string line_, last_;
};

/// Waits for the child to exit; terminates it once the run is cancelled.
int waitForExit(ChildProcess& child, OutputReader& reader, const std::function<bool()>& cancelled) {
    std::optional<Clock::time_point> terminated_at;
    std::optional<int> status;
    while (!(status = child.waitStatus())) {
        reader.append(child.read(kPoll));
        if (!cancelled()) continue;
        if (!terminated_at) {
            child.terminate();
            terminated_at = Clock::now();
        } else if (Clock::now() - *terminated_at > kGrace) {
            child.kill();
        }
    }
    for (std::string rest; !(rest = child.read({})).empty();) reader.append(rest);
    return *status;
}

std::unique_ptr<ChildProcess> start(const std::vector<std::string>& arguments) {
    try {
        return std::make_unique<ChildProcess>(arguments);
    } catch (const std::system_error& error) {
        throw Error{ExitCode::kCannotRun, error.what()};
    }
}

} // namespace

ToolResult runTool(const std::vector<std::string>& arguments, const std::string& name,
                   const std::function<bool()>& cancelled,
                   const std::function<bool(const std::string& line)>& on_line) {
    OutputReader reader(on_line);
    const auto child = start(arguments);
    const int status = waitForExit(*child, reader, cancelled);
    return {status, reader.lastLine(name)};
}

std::string describeFailure(const ToolResult& end, const std::string& name) {
    const bool said_why = exitStatusOf(end.wait_status) && !end.last_line.empty();
    return said_why ? end.last_line : name + " " + describeExit(end.wait_status);
}

ExitCode exitCodeOf(const ToolResult& end) {
    const int status = exitStatusOf(end.wait_status).value_or(0);
    const bool ours = status > 0 && status <= static_cast<int>(ExitCode::kCannotWrite);
    return ours ? static_cast<ExitCode>(status) : ExitCode::kCannotRun;
}

std::string safeArgument(const std::string& path) { return path.starts_with('/') ? path : "./" + path; }

} // namespace pointrt

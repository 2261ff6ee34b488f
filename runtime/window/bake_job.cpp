// SPDX-License-Identifier: Apache-2.0
#include "runtime/window/bake_job.h"

#include <signal.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <optional>

#include "pointrt/tool.hpp"
#include "runtime/window/child_process.h"

namespace pointrt {
namespace {

using Clock = std::chrono::steady_clock;

/// How soon a cancelled bake is asked to end, and how long it may take over it.
constexpr std::chrono::milliseconds kPoll{50};
constexpr std::chrono::seconds kGrace{3};
/// More than any line that is worth showing.
constexpr std::size_t kLongestLine = 4096;

/// The lines that a program has written: progress goes to the control, the last of the others is kept.
class Listener {
public:
    explicit Listener(JobControl& control) : control_(control) {}

    void hear(const std::string& bytes) {
        for (const char c : bytes) {
            if (c != '\n') {
                if (line_.size() < kLongestLine) line_ += c;
                continue;
            }
            if (!line_.empty() && !tellBakeProgress(line_, control_)) last_ = line_;
            line_.clear();
        }
    }

    /// Without the tool's name; the last word counts even without an end of line.
    std::string lastLine() const {
        const std::string prefix = "pointrt-bake: error: ", line = line_.empty() ? last_ : line_;
        return line.starts_with(prefix) ? line.substr(prefix.size()) : line;
    }

private:
    JobControl& control_;
    std::string line_, last_;
};

/// Until it has ended. Asks it to when the control says so.
int attend(ChildProcess& child, Listener& listener, const JobControl& control) {
    std::optional<Clock::time_point> asked;
    std::optional<int> status;
    while (!(status = child.waitStatus())) {
        listener.hear(child.read(kPoll));
        if (!control.cancelled()) continue;
        if (!asked) {
            child.signal(SIGTERM);
            asked = Clock::now();
        } else if (Clock::now() - *asked > kGrace) {
            child.signal(SIGKILL);
        }
    }
    for (std::string rest; !(rest = child.read({})).empty();) listener.hear(rest);
    return *status;
}

/// So that no program takes it for an option or a list.
std::string asArgument(const std::string& path) { return path.starts_with('/') ? path : "./" + path; }

void bake(const BakePlan& plan, const std::string& baker, JobControl& control) {
    std::vector<std::string> arguments{baker, "--progress", "lines", "-o", asArgument(plan.output)};
    for (const std::string& input : plan.inputs) arguments.push_back(asArgument(input));
    Listener listener(control);
    ChildProcess child(arguments);
    const int status = attend(child, listener, control);
    if (control.cancelled()) {
        // all that one killed while it wrote can leave: format/src/atomic_file.cpp
        unlink((plan.output + ".tmp-" + std::to_string(child.id())).c_str());
        throw JobCancelled{};
    }
    const std::string name = "pointrt-bake ";
    if (status != 0) {
        const std::string reason = WIFEXITED(status) ? listener.lastLine() : std::string();
        throw Error{ExitCode::kCannotRun, reason.empty() ? name + describeEnd(status) : reason};
    }
    std::error_code ignored;
    if (!std::filesystem::is_regular_file(plan.output, ignored))
        throw Error{ExitCode::kCannotRun, name + "ended well, but there is no " + plan.output};
}

std::string titleOf(const BakePlan& plan) {
    const std::string first = std::filesystem::path(plan.inputs.at(0)).filename().string();
    const std::size_t more = plan.inputs.size() - 1;
    return "Baking " + first + (more > 0 ? " and " + std::to_string(more) + " more" : "");
}

std::string rateText(double points_per_second) {
    std::array<char, 48> text{};
    if (points_per_second >= 1e6)
        std::snprintf(text.data(), text.size(), ", %.1f M points/s", points_per_second / 1e6);
    else if (points_per_second >= 1e3)
        std::snprintf(text.data(), text.size(), ", %.0f k points/s", points_per_second / 1e3);
    return text.data();
}

} // namespace

BakeJob::BakeJob(const BakePlan& plan, const std::string& baker)
    : output_(plan.output), job_(titleOf(plan), [plan, baker](JobControl& control) { bake(plan, baker, control); }) {}

bool tellBakeProgress(const std::string& line, JobControl& control) {
    double share = 0, rate = 0;
    std::array<char, 32> stage{};
    int end = 0;
    const int fields = std::sscanf(line.c_str(), "progress %lf %31s %lf%n", &share, stage.data(), &rate, &end);
    if (fields != 3 || static_cast<std::size_t>(end) != line.size() || !(share >= 0 && share <= 1)) return false;
    control.say(stage.data() + rateText(rate));
    control.setShare(share);
    return true;
}

} // namespace pointrt

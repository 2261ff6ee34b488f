// SPDX-License-Identifier: Apache-2.0
#include "runtime/window/edit/bake_job.h"

#include <unistd.h>

#include <array>
#include <cstdio>
#include <filesystem>

#include "format/base/error.h"
#include "runtime/window/edit/tool_run.h"

namespace pointrt {
namespace {

void bake(const BakePlan& plan, const std::string& baker, JobControl& control) {
    const std::string name = "pointrt-bake";
    std::vector<std::string> arguments{baker, "--progress", "lines", "-o", safeArgument(plan.output)};
    for (const std::string& input : plan.inputs) arguments.push_back(safeArgument(input));
    const ToolResult end =
        runTool(arguments, name, control, [&](const std::string& line) { return parseBakeProgress(line, control); });
    if (control.cancelled()) {
        // a killed pointrt-bake can leave only this file: format/base/atomic_file.cpp
        unlink((plan.output + ".tmp-" + std::to_string(end.id)).c_str());
        throw JobCancelled{};
    }
    if (end.wait_status != 0) throw Error{exitCodeOf(end), describeFailure(end, name)};
    std::error_code ignored;
    if (!std::filesystem::is_regular_file(plan.output, ignored))
        throw Error{ExitCode::kCannotRun, name + " succeeded but did not write " + plan.output};
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

bool parseBakeProgress(const std::string& line, JobControl& control) {
    double share = 0, rate = 0;
    std::array<char, 32> stage{};
    int end = 0;
    const int fields = std::sscanf(line.c_str(), "progress %lf %31s %lf%n", &share, stage.data(), &rate, &end);
    if (fields != 3 || static_cast<std::size_t>(end) != line.size() || !(share >= 0 && share <= 1)) return false;
    control.setDetail(stage.data() + rateText(rate));
    control.setProgress(share);
    return true;
}

} // namespace pointrt

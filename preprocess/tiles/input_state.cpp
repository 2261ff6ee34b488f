// SPDX-License-Identifier: GPL-3.0-or-later
#include "preprocess/tiles/input_state.h"

#include <fmt/format.h>

#include <cerrno>
#include <cstring>
#include <nlohmann/json.hpp>

#include "format/base/error.h"
#include "format/os/descriptor.h"

namespace pointrt {

std::vector<PlanInput> statesOf(const std::vector<std::string>& paths) {
    std::vector<PlanInput> states;
    for (const std::string& path : paths) {
        const auto status = statusOf(path);
        const auto refuse = [&](const std::string& reason) { throw Error(ExitCode::kBadInput, path + ": " + reason); };
        if (!status) refuse(errno == ENOENT ? "no such file" : std::strerror(errno));
        if (status->kind != FileKind::kRegular) refuse("is not a regular file; a tile set reads its inputs twice");
        PlanInput& state = states.emplace_back();
        state.path = path;
        state.bytes = status->bytes;
        state.modified_ns = status->modified_ns;
    }
    return states;
}

namespace {

[[noreturn]] void refuse(const SetPlan& plan, const std::string& reason) {
    throw Error(ExitCode::kBadInput, plan.work + ": " + reason + "; --force starts again");
}

/// The path as in the plan: valid UTF-8.
std::string named(const std::string& path) {
    using Json = nlohmann::json;
    return Json::parse(Json(path).dump(-1, ' ', false, Json::error_handler_t::replace)).get<std::string>();
}

} // namespace

void requireSameInputs(const SetPlan& plan, const std::vector<std::string>& paths) {
    if (paths.size() != plan.inputs.size())
        refuse(plan, fmt::format("was started with {} input files, not {}", plan.inputs.size(), paths.size()));
    for (std::size_t i = 0; i < paths.size(); ++i)
        if (named(paths[i]) != plan.inputs[i].path)
            refuse(plan, fmt::format("was started with {}, not {}", plan.inputs[i].path, paths[i]));
}

void requireUnwritten(const SetPlan& plan, const std::vector<std::string>& paths) {
    const std::vector<PlanInput> now = statesOf(paths);
    for (std::size_t i = 0; i < now.size(); ++i) {
        const PlanInput& then = plan.inputs.at(i);
        if (now[i].bytes != then.bytes || now[i].modified_ns != then.modified_ns)
            refuse(plan, then.path + " has changed since the bake was started");
    }
}

} // namespace pointrt

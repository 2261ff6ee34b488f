// SPDX-License-Identifier: GPL-3.0-or-later
// What a request asks of options, inputs and disk.
#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <nlohmann/json.hpp>

#include "format/base/error.h"
#include "preprocess/sets/bucket_layout.h"
#include "preprocess/sets/split/input_state.h"
#include "preprocess/sets/split/make_plan.h"

namespace pointrt {
namespace {

std::string gigabytes(std::uint64_t bytes) {
    return bytes < 100'000'000 ? fmt::format("{:.1f} MB", static_cast<double>(bytes) / 1e6)
                               : fmt::format("{:.1f} GB", static_cast<double>(bytes) / 1e9);
}

std::filesystem::path folderOf(const std::string& path) {
    const std::filesystem::path parent = std::filesystem::path(path).parent_path();
    return parent.empty() ? "." : parent;
}

} // namespace

std::string workFolderOf(const std::string& output) {
    std::string folder = output;
    while (folder.size() > 1 && folder.back() == '/') folder.pop_back();
    return folder + ".work";
}

void requirePossible(const SetRequest& request) {
    const auto refuse = [](const char* text) { throw Error(ExitCode::kBadUsage, text); };
    if (std::find(request.inputs.begin(), request.inputs.end(), "-") != request.inputs.end())
        refuse("-: standard input can be read only once, and a tile set reads its inputs twice");
    if (request.read.sample_count.value_or(0) > 0 && request.inputs.size() > 1)
        refuse("--sample: a tile set samples each file by itself: bake meshes one by one, or leave the number to it");
    if (request.bake.max_memory < std::uint64_t{512} << 20) refuse("--max-memory: below 512M there is no room to work");
}

/// Splats wait for their tiles with position, normal, radius, noise, colour and attributes. A tile has some 24 bytes a
/// splat (README) and attributes, and in sets of airborne lidar 56 of index, of which it was 82 in single files;
/// coarser levels and what tiles repeat of each other were a seventh of the original splats there.
SpaceNeeded spaceNeeded(const SetPlan& plan) {
    constexpr std::uint64_t kWaiting = 40, kTile = 24, kIndex = 60;
    constexpr double kLevelsAndRepeats = 1.2;
    std::uint64_t attributes = 0;
    for (const PlanAttribute& each : plan.schema.attributes) attributes += each.bytesEach();
    SpaceNeeded needed;
    needed.temporary = plan.points * (BucketLayout(plan.schema).record_bytes + kWaiting + attributes);
    const std::uint64_t each = kTile + attributes + (plan.bake.index ? kIndex : 0);
    needed.final = static_cast<std::uint64_t>(kLevelsAndRepeats * static_cast<double>(plan.points * each));
    // Splats go as tiles come, but those of coarser tiles, a third of the original ones, and those at the border of
    // what is made.
    constexpr std::uint64_t kWaitingToTheEnd = kWaiting / 2;
    needed.peak = needed.temporary + needed.final;
    if (plan.bake.drop_work)
        needed.peak = std::max(needed.temporary + plan.points * kWaitingToTheEnd, // of levels, before tiles
                               needed.final + plan.points * kWaitingToTheEnd);
    return needed;
}

std::string spaceLine(const SetPlan& plan) {
    const SpaceNeeded needed = spaceNeeded(plan);
    return fmt::format("about {} of disk at most and {} in the end", gigabytes(needed.peak), gigabytes(needed.final));
}

void requireSpace(const SetPlan& plan) {
    const SpaceNeeded needed = spaceNeeded(plan);
    std::error_code failure;
    const std::filesystem::space_info space = std::filesystem::space(folderOf(plan.output), failure);
    if (failure || space.available >= needed.peak) return;
    throw Error(ExitCode::kCannotWrite, fmt::format("{}: needs {}; the disk has {} left", plan.output, spaceLine(plan),
                                                    gigabytes(space.available)));
}

void requireSameRequest(const SetPlan& plan, const SetRequest& request) {
    using Json = nlohmann::json;
    const Json then = Json::parse(plan.settings, nullptr, false), now = Json::parse(request.settings, nullptr, false);
    const auto text = [](const Json& json, const std::string& name) {
        return json.contains(name) ? json.at(name).dump(-1, ' ', false, Json::error_handler_t::replace) : "no value";
    };
    for (const auto& [name, value] : now.items())
        if (text(then, name) != text(now, name))
            throw Error(ExitCode::kBadUsage, fmt::format("{}: was begun with {} of --{}, not {}; --force begins anew",
                                                         plan.work, text(then, name), name, text(now, name)));
    if (then != now)
        throw Error(ExitCode::kBadUsage, plan.work + ": was begun with other options; --force begins anew");
}

} // namespace pointrt

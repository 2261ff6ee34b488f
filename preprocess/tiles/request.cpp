// SPDX-License-Identifier: GPL-3.0-or-later
// Checks of a request: options, inputs and disk space.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <nlohmann/json.hpp>

#include "format/base/error.h"
#include "format/os/separators.h"
#include "preprocess/tiles/bucket_layout.h"
#include "preprocess/tiles/input_state.h"
#include "preprocess/tiles/make_plan.h"

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

double attributeBytes(const SetPlan& plan) {
    double bytes = 0;
    for (const PlanAttribute& each : plan.schema.attributes) bytes += static_cast<double>(each.bytesEach());
    return bytes;
}

/// Size in bytes of a splat in a splat file (tile_splats.h).
double waitingBytes(const SetPlan& plan) {
    const std::size_t position_normal_radius = 3 * sizeof(std::int32_t) + sizeof(std::uint32_t) + sizeof(float);
    const std::size_t color = plan.schema.colors ? sizeof(Rgb8) : 0;
    const std::size_t noise = plan.bake.surface.clean > 0 ? sizeof(float) : 0;
    return static_cast<double>(position_normal_radius + color + noise) + attributeBytes(plan);
}

} // namespace

std::string workFolderOf(const std::string& output) {
    std::string folder = output;
    while (folder.size() > 1 && isFolderSeparator(folder.back())) folder.pop_back();
    return folder + ".work";
}

void requirePossible(const SetRequest& request) {
    const auto refuse = [](const char* text) { throw Error(ExitCode::kBadUsage, text); };
    if (std::find(request.inputs.begin(), request.inputs.end(), "-") != request.inputs.end())
        refuse("-: standard input cannot be read twice, as a tile set needs");
    if (request.read.sample_count.value_or(0) > 0 && request.inputs.size() > 1)
        refuse("--sample: tile sets choose the number of samples of each mesh; bake meshes one by one to set it");
    if (request.bake.max_memory < std::uint64_t{512} << 20) refuse("--max-memory: must be at least 512M");
}

/// A tile takes about 24 bytes per splat (README) plus attributes and, in airborne lidar sets, 50 to 56 bytes of index
/// (82 in single files). Coarser levels and splats repeated in adjacent tiles were a seventh of the original splats
/// there, and a third of the splat files.
SpaceNeeded spaceNeeded(const SetPlan& plan) {
    constexpr double kTile = 24, kIndex = 60, kLevelsAndRepeats = 1.2, kWithLevels = 1.4;
    const auto points = static_cast<double>(plan.points);
    const double buckets = points * static_cast<double>(BucketLayout(plan.schema).record_bytes);
    const double splats = points * waitingBytes(plan), all_splats = kWithLevels * splats;
    const double originals = points * (kTile + attributeBytes(plan) + (plan.bake.index ? kIndex : 0));
    const double final = kLevelsAndRepeats * originals;
    // Splat files are dropped as tiles are made, except those that coarser tiles read: after the original tiles, two
    // thirds of their splat files were left.
    constexpr double kLeftForCoarser = 0.7;
    const double at_once = plan.bake.drop_work
                               ? std::max({buckets + splats, all_splats, final, originals + kLeftForCoarser * splats})
                               : buckets + all_splats + final;
    const auto whole = [](double bytes) { return static_cast<std::uint64_t>(std::llround(bytes)); };
    return {whole(buckets + all_splats), whole(final), whole(at_once)};
}

std::string spaceLine(const SetPlan& plan) {
    const SpaceNeeded needed = spaceNeeded(plan);
    return fmt::format("up to {} of disk space during the bake, {} at the end", gigabytes(needed.peak),
                       gigabytes(needed.final));
}

void requireSpace(const SetPlan& plan) {
    const SpaceNeeded needed = spaceNeeded(plan);
    std::error_code failure;
    const std::filesystem::space_info space = std::filesystem::space(folderOf(plan.output), failure);
    if (failure || space.available >= needed.peak) return;
    throw Error(ExitCode::kCannotWrite, fmt::format("{}: needs {}, but the disk has {} left", plan.output,
                                                    spaceLine(plan), gigabytes(space.available)));
}

void requireSameRequest(const SetPlan& plan, const SetRequest& request) {
    using Json = nlohmann::json;
    const Json then = Json::parse(plan.settings, nullptr, false), now = Json::parse(request.settings, nullptr, false);
    const auto text = [](const Json& json, const std::string& name) {
        return json.contains(name) ? json.at(name).dump(-1, ' ', false, Json::error_handler_t::replace) : "no value";
    };
    for (const auto& [name, value] : now.items())
        if (text(then, name) != text(now, name))
            throw Error(ExitCode::kBadUsage,
                        fmt::format("{}: was started with a different --{} ({}, not {}); --force starts again",
                                    plan.work, name, text(then, name), text(now, name)));
    if (then != now)
        throw Error(ExitCode::kBadUsage, plan.work + ": was started with other options; --force starts again");
}

} // namespace pointrt

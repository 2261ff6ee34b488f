// SPDX-License-Identifier: GPL-3.0-or-later
#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "format/base/report_file.h"
#include "format/base/up_text.h"
#include "format/os/memory.h"
#include "preprocess/app/bake_set.h"
#include "preprocess/app/report.h"
#include "preprocess/app/vector_json.h"
#include "preprocess/tiles/make_plan.h"

namespace pointrt {
namespace {

using Json = nlohmann::ordered_json;

Json stepsJson(const SetReport& report) {
    Json steps = Json::array();
    for (const SetStepReport& each : report.steps)
        steps.push_back(
            {{"step", each.step}, {"points", each.points}, {"bytes", each.bytes}, {"seconds", each.seconds}});
    return steps;
}

Json filesJson(const SetPlan& plan) {
    Json files = Json::array();
    for (const PlanInput& each : plan.inputs)
        files.push_back({{"name", each.path},
                         {"format", each.format},
                         {"points", each.points},
                         {"kept", each.kept},
                         {"scans", each.scans}});
    return files;
}

Json toJson(const SetReport& report) {
    const SetPlan& plan = report.plan;
    const SpaceNeeded space = spaceNeeded(plan);
    Json json;
    json["input_points"] = plan.points_read;
    json["points"] = plan.points;
    json["points_non_finite"] = plan.points_non_finite;
    json["points_filtered"] = plan.points_filtered;
    json["points_stray"] = plan.points_stray;
    json["blocks"] = plan.blocks();
    json["points_lacking_neighbors"] = report.points_lacking_neighbors;
    json["balls"] = report.balls;
    json["levels"] = plan.levels;
    json["original_tiles"] = plan.tiles.size();
    json["tiles"] = report.tiles;
    json["splats"] = report.splats;
    json["bytes"] = report.bytes;
    json["done"] = report.done;
    json["space"] = {{"temporary", space.temporary}, {"final", space.final}, {"peak", space.peak}};
    json["up"] = vectorJson(plan.world.up);
    json["up_from"] = plan.up_from;
    json["up_reason"] = plan.up_reason;
    json["noise"] = plan.statistics.noise;
    json["files"] = filesJson(plan);
    json["notes"] = Json::array();
    for (const Note& note : plan.notes) json["notes"].push_back(noteLine(note));
    json["steps"] = stepsJson(report);
    json["peak_rss_bytes"] = peakRssBytes();
    json["seconds"]["total"] = report.seconds_total;
    return json;
}

/// " (left out 2 not finite, 1 outliers)", or nothing.
std::string leftOutText(const SetPlan& plan) {
    std::string text;
    for (const auto& [count, what] :
         {std::pair{plan.points_non_finite, "not finite"}, std::pair{plan.points_filtered, "filtered out"},
          std::pair{plan.points_stray, "outliers"}})
        if (count > 0) text += fmt::format("{}{} {}", text.empty() ? " (left out " : ", ", count, what);
    return text.empty() ? text : text + ")";
}

/// "; up is a guess: z, as in most point clouds (change it with --up)", or nothing.
std::string foundUpText(const SetPlan& plan) {
    const Vec3d& up = plan.world.up;
    const std::string text = upText({up.x(), up.y(), up.z()}, plan.up_from, plan.up_reason);
    return text.empty() ? text : "; " + text;
}

} // namespace

std::string summaryLine(const SetReport& report) {
    const SetPlan& plan = report.plan;
    if (!report.done) {
        std::string steps;
        for (const SetStepReport& each : report.steps) steps += (steps.empty() ? "" : ", ") + each.step;
        return fmt::format("{}: {} points in {} tiles and {} blocks, {:.2f} s",
                           steps.empty() ? "nothing left to do" : steps + " done", plan.points, plan.tiles.size(),
                           plan.blocks(), report.seconds_total);
    }
    return fmt::format("{} points{}, {} splats in {} tiles of {} levels, {} bytes ({:.1f} per splat), {:.2f} s{}",
                       plan.points, leftOutText(plan), report.splats, report.tiles, plan.levels, report.bytes,
                       static_cast<double>(report.bytes) / static_cast<double>(report.splats), report.seconds_total,
                       foundUpText(plan));
}

void writeStats(const SetReport& report, const std::string& path) {
    // names need not be UTF-8
    writeReport(path, toJson(report).dump(2, ' ', false, Json::error_handler_t::replace) + "\n");
}

} // namespace pointrt

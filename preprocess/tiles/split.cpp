// SPDX-License-Identifier: GPL-3.0-or-later
#include "preprocess/tiles/split.h"

#include <fmt/format.h>

#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <optional>

#include "format/base/error.h"
#include "format/base/json_integer.h"
#include "format/os/atomic_file.h"
#include "preprocess/tiles/bucket_writer.h"
#include "preprocess/tiles/gaussian_tiles.h"
#include "preprocess/tiles/measure_statistics.h"

namespace pointrt {
namespace {

using Json = nlohmann::json;

/// Saved progress between two files.
struct Mark {
    StreamPlace place;
    std::vector<std::uint64_t> bytes; ///< [tiles] of their buckets
};

std::string markFile(const SetPlan& plan) { return plan.work + "/split.begun.json"; }

void writeJson(const std::string& path, const Json& json) {
    const std::string text = json.dump() + "\n";
    format::AtomicFile file;
    if (!file.open(path) || !file.write(text.data(), text.size()) || !file.commit())
        throw Error(ExitCode::kCannotWrite, path + ": " + file.error());
}

void writeMark(const SetPlan& plan, const Mark& mark) {
    const StreamPlace& place = mark.place;
    writeJson(markFile(plan), {{"file", place.file},
                               {"scan", place.scan},
                               {"kept", place.kept},
                               {"seen", place.seen},
                               {"bytes", mark.bytes}});
}

std::optional<Mark> readMark(const SetPlan& plan) {
    std::ifstream stream(markFile(plan));
    const Json json = Json::parse(stream, nullptr, false);
    try {
        Mark mark;
        mark.place.file = jsonInteger<std::size_t>(json.at("file"));
        mark.place.scan = jsonInteger<std::size_t>(json.at("scan"));
        mark.place.kept = jsonInteger<std::uint64_t>(json.at("kept"));
        mark.place.seen = jsonInteger<std::uint64_t>(json.at("seen"));
        for (const Json& each : json.at("bytes")) mark.bytes.push_back(jsonInteger<std::uint64_t>(each));
        if (mark.place.file > plan.inputs.size() || mark.place.scan > plan.scans.size()) return std::nullopt;
        return mark;
    } catch (const Json::exception&) {
        return std::nullopt; // without a valid mark
    }
}

/// The findings of the first pass that the second needs.
StreamFindings findingsOf(const SetPlan& plan) {
    StreamFindings first_pass;
    for (const PlanScan& scan : plan.scans) first_pass.largest_color.push_back(scan.largest_color);
    const PlanSchema& schema = plan.schema;
    const std::size_t stored = schema.attributes.size() - (schema.scan_attribute ? 1 : 0);
    for (std::size_t i = 0; i < stored; ++i) {
        const PlanAttribute& each = schema.attributes[i];
        first_pass.cloud.attributes.push_back({each.name, each.read_type, each.components, {}});
    }
    return first_pass;
}

std::vector<StreamNoData> noDataOf(const SetPlan& plan) {
    std::vector<StreamNoData> all;
    for (std::size_t scan = 0; scan < plan.scans.size(); ++scan)
        for (const NoData& each : plan.scans[scan].no_data) all.push_back({scan, each});
    return all;
}

void requireCounts(const SetPlan& plan, const std::vector<std::uint64_t>& counts) {
    for (std::size_t i = 0; i < counts.size(); ++i)
        if (counts[i] != plan.tiles[i].points)
            throw Error(
                ExitCode::kBadInput,
                fmt::format("{}: the inputs have changed since the plan was made (a tile had {} points, now {}); "
                            "--force starts again",
                            plan.work, plan.tiles[i].points, counts[i]));
}

} // namespace

bool isSplit(const SetPlan& plan) {
    std::error_code failure;
    return std::filesystem::exists(splitMark(plan), failure);
}

void splitPoints(const SetPlan& plan, const SetRequest& request, const ReadProgress& progress,
                 const SplitOptions& options) {
    if (isSplit(plan)) return;
    constexpr std::uint64_t kBufferShare = 8; // buffers get one part in this many of the memory
    BucketWriter writer(plan, plan.bake.max_memory / kBufferShare);
    const StreamFindings first_pass = findingsOf(plan);
    StreamOptions stream = streamOptionsOf(request);
    stream.first_pass = &first_pass;
    stream.no_data = noDataOf(plan);
    const std::optional<Mark> mark = readMark(plan);
    if (mark && writer.resume(mark->bytes))
        stream.start = mark->place;
    else
        writer.restart();
    std::uint64_t marked = stream.start.kept;
    stream.file_done = [&](const StreamPlace& place) {
        const bool is_last = place.file == request.inputs.size();
        // the occupied cells of thinning are not saved
        const bool can_resume = request.read.filter.thin_spacing <= 0 || is_last;
        if (!can_resume || (place.kept - marked < options.points_between_marks && !is_last)) return;
        writeMark(plan, {place, writer.flush()});
        marked = place.kept;
    };
    if (stream.start.file < request.inputs.size())
        readInBatches(
            request.inputs, stream,
            [&](const PointBatch& batch) {
                const GridPriors priors = gridPriorsOf(batch, request.bake.surface, PriorKinds::kAll);
                writer.add(movedBatch(batch, priors), priors);
            },
            progress);
    requireCounts(plan, writer.counts());
    writer.finish();
    writeStatistics(plan, holdsGaussians(plan) ? CloudStatistics() : measureStatistics(plan));
    writeJson(splitMark(plan), {{"points", plan.points}});
    std::error_code failure;
    std::filesystem::remove(markFile(plan), failure);
}

} // namespace pointrt

// SPDX-License-Identifier: GPL-3.0-or-later
#include "preprocess/app/bake_set.h"

#include <fmt/format.h>
#include <tbb/global_control.h>

#include <algorithm>
#include <filesystem>
#include <nlohmann/json.hpp>

#include "format/base/error.h"
#include "format/os/file_lock.h"
#include "format/os/folder.h"
#include "format/set/tile_set.h"
#include "preprocess/app/bake_progress.h"
#include "preprocess/app/checks.h"
#include "preprocess/app/interrupt.h"
#include "preprocess/app/name_set.h"
#include "preprocess/app/report.h"
#include "preprocess/app/set_options.h"
#include "preprocess/tiles/bake_block.h"
#include "preprocess/tiles/input_state.h"
#include "preprocess/tiles/make_tiles.h"
#include "preprocess/tiles/split.h"

namespace pointrt {
namespace {

namespace fs = std::filesystem;

/// Share of the time per step, in percent, as measured on lidar.
const std::vector<StageWeight> kSetWeights{{"plan", 4},   {"split", 6}, {"block", 55},
                                           {"levels", 5}, {"tile", 22}, {"top", 8}};

SetRequest requestOf(const BakeOptions& options) {
    SetRequest request;
    request.inputs = options.inputs;
    request.output = options.output;
    request.read = options.read;
    request.up = options.up;
    request.points_per_tile = options.tiles.points_per_tile;
    request.bake.surface = options.surface;
    request.bake.octree = options.octree;
    request.bake.prune = options.prune;
    request.bake.pruning = options.pruning;
    request.bake.index = options.index;
    request.bake.reflectivity = options.reflectivity;
    request.bake.max_memory = options.tiles.max_memory;
    request.bake.drop_work = options.tiles.step == SetStep::kAll && !options.tiles.keep_work;
    request.settings = tileSetSettings(options);
    return request;
}

/// Locks the work folder: two processes that plan or split one set would overwrite each other's files.
class WorkFolderLock {
public:
    explicit WorkFolderLock(const std::string& work) {
        if (!lock_.openFolder(work) || lock_.take() != format::LockResult::kLocked)
            throw Error(ExitCode::kCannotWrite, work + ": " + lock_.failure());
    }

private:
    format::FileLock lock_;
};

/// One bake, or the step of one.
class SetBake {
public:
    explicit SetBake(const BakeOptions& options)
        : options_(options), request_(requestOf(options)), work_(workFolderOf(options.output)),
          progress_(options.verbosity, options.progress, kSetWeights) {}

    SetReport run() {
        clearNamed(options_.output, work_, options_.tiles.keep_work);
        checkOutput();
        keepWorkOnInterrupt();
        if (does(SetStep::kPlan) || does(SetStep::kSplit)) {
            makeFolder(work_);
            const WorkFolderLock lock(work_);
            try {
                plan();
            } catch (...) {
                std::error_code failure;
                fs::remove(work_, failure); // only if empty
                throw;
            }
            if (does(SetStep::kSplit)) split();
        } else {
            openPlan();
            requireSplit();
            requireBlock();
        }
        if (does(SetStep::kBlock)) blocks();
        if (does(SetStep::kLevels)) levels();
        if (does(SetStep::kTile)) tiles();
        if (does(SetStep::kTop)) finish();
        progress_.finish();
        collectSeconds();
        return std::move(report_);
    }

private:
    void checkOutput() const {
        if (!fs::exists(options_.output)) return;
        if (fs::is_directory(options_.output) && fs::is_empty(options_.output))
            return; // workflow engines create it in advance
        const bool is_set = fs::is_directory(options_.output) && fs::exists(options_.output + "/set.json");
        if (!is_set) throw Error(ExitCode::kCannotWrite, options_.output + ": exists and is not a tile set");
        if (!options_.force)
            throw Error(ExitCode::kCannotWrite, options_.output + ": already exists; --force overwrites it");
    }

    /// Reads the existing plan, which must be for the same request.
    void openPlan() {
        report_.plan = readPlan(work_);
        requireSameRequest(report_.plan, request_);
        report_.plan.output = options_.output;
        report_.plan.bake = request_.bake;
    }

    void requireSplit() const {
        if (!isSplit(report_.plan)) throw Error(ExitCode::kBadInput, work_ + ": the step split has not been completed");
    }

    bool does(SetStep step) const { return options_.tiles.step == SetStep::kAll || options_.tiles.step == step; }

    void requireBlock() const {
        const std::uint32_t blocks = report_.plan.blocks();
        if (options_.tiles.block < blocks) return;
        throw Error(ExitCode::kBadUsage, fmt::format("--step: block {} is out of range: {} has blocks 0 to {}",
                                                     options_.tiles.block, work_, blocks - 1));
    }

    /// The plan with the folder in which the set is assembled.
    SetPlan assemblyPlan() const {
        SetPlan plan = report_.plan;
        plan.output = finishedFolder(work_);
        return plan;
    }

    /// The metadata for META of the tiles.
    std::string metadata() const {
        nlohmann::ordered_json json{{"writer", "pointrt-bake " POINTRT_VERSION}};
        const SetPlan& plan = report_.plan;
        if (!plan.up_reason.empty()) json["world"] = {{"up_from", plan.up_from}, {"up_reason", plan.up_reason}};
        return json.dump();
    }

    /// Whether a previous bake can be resumed. With --force a plan for other options or inputs is discarded.
    bool canResume() {
        if (!fs::exists(planFile(work_))) return false;
        try {
            openPlan();
            requireSameInputs(report_.plan, options_.inputs);
            if (!isSplit(report_.plan)) requireUnwritten(report_.plan, options_.inputs); // they are read again
            return true;
        } catch (const Error&) {
            if (!options_.force) throw;
        }
        discardWork();
        return false;
    }

    /// Deletes the plan last: without the plan, files that remain would be taken for results of the next one.
    void discardWork() const {
        const std::string plan = planFile(work_);
        std::error_code failure;
        const std::vector<std::string> paths = listFolder(work_, failure);
        if (failure) throw Error(ExitCode::kCannotWrite, work_ + ": " + failure.message());
        for (const std::string& path : paths)
            if (path != plan) removeTree(path);
        removeTree(plan);
    }

    void plan() {
        const bool resumes = canResume();
        if (!resumes) {
            progress_.begin("plan", 0);
            report_.plan = makePlan(request_, [&](const ReadStatus& status) { showReading(status); });
            requireSpace(report_.plan);
            writePlan(report_.plan);
            add("plan", report_.plan.points_read, fs::file_size(planFile(work_)));
        }
        const SetPlan& plan = report_.plan;
        if (!resumes)
            for (const Note& note : plan.notes) progress_.note(noteLine(note));
        progress_.note(fmt::format("{}{} points in {} tiles, {} blocks; {}", resumes ? "resuming: " : "", plan.points,
                                   plan.tiles.size(), plan.blocks(), spaceLine(plan)));
    }

    void split() {
        SetPlan& plan = report_.plan;
        if (isSplit(plan)) return;
        progress_.begin("split", plan.points_read);
        splitPoints(plan, request_, [&](const ReadStatus& status) { progress_.update(status.share); });
        plan.statistics = readPlan(work_).statistics;
        std::uint64_t bytes = 0;
        for (const PlanTile& tile : plan.tiles) bytes += fs::file_size(bucketFile(plan, tile));
        add("split", plan.points, bytes);
    }

    /// The block of --step, or all blocks.
    BlockRange selectedBlocks() const {
        if (options_.tiles.step == SetStep::kAll) return {0, report_.plan.blocks()};
        return {options_.tiles.block, options_.tiles.block + 1};
    }

    std::uint64_t pointsOf(BlockRange blocks) const {
        const TileRange tiles = tilesOf(report_.plan, blocks);
        std::uint64_t points = 0;
        for (std::uint32_t i = tiles.first; i < tiles.end; ++i) points += report_.plan.tiles[i].points;
        return points;
    }

    void blocks() {
        if (fs::exists(blocksMark(report_.plan))) return;
        const BlockRange selected = selectedBlocks();
        const std::uint64_t points = pointsOf(selected);
        progress_.begin("block", points);
        const TileCounts counts = bakeBlocks(report_.plan, selected, threadCount(options_),
                                             [&](const char*, double share) { progress_.update(share); });
        report_.points_lacking_neighbors = counts.lacking;
        report_.balls = counts.balls;
        add("block", points, 0);
        dropBuckets();
        if (report_.points_lacking_neighbors > 0)
            progress_.note(
                fmt::format("{} points have neighbours too far away in other tiles; their normals may differ from "
                            "those of a single-file bake",
                            report_.points_lacking_neighbors));
    }

    void tiles() {
        const BlockRange blocks = selectedBlocks();
        const std::uint64_t points = pointsOf(blocks);
        progress_.begin("tile", points);
        makeBlockTiles(assemblyPlan(), blocks, metadata(), threadCount(options_),
                       [&](const char*, double share) { progress_.update(share); });
        add("tile", points, 0);
    }

    void dropBuckets() const {
        if (!request_.bake.drop_work) return;
        writeMark(blocksMark(report_.plan));
        std::error_code failure; // files that cannot be deleted do no harm
        removeAll(bucketsFolder(report_.plan), failure);
    }

    void levels() {
        if (fs::exists(levelsMark(report_.plan))) return;
        progress_.begin("levels", report_.plan.points);
        mergeLevels(report_.plan, options_.tiles.points_per_tile, threadCount(options_),
                    [&](const char*, double share) { progress_.update(share); });
        if (request_.bake.drop_work) writeMark(levelsMark(report_.plan));
        add("levels", report_.plan.points, 0);
    }

    void finish() {
        progress_.begin("top", report_.plan.points);
        const TileSet set = makeSet(assemblyPlan(), metadata(), threadCount(options_),
                                    [&](const char*, double share) { progress_.update(share); });
        report_.splats = set.splats;
        report_.tiles = set.tiles.size();
        for (const SetTile& tile : set.tiles) report_.bytes += tile.bytes;
        add("top", report_.plan.points, report_.bytes);
        ignoreInterrupts();
        nameSet(report_.plan, options_.tiles.keep_work);
        report_.done = true;
    }

    void showReading(const ReadStatus& status) {
        if (status.share > 0)
            progress_.setPoints(static_cast<std::uint64_t>(static_cast<double>(status.points) / status.share));
        progress_.update(status.share);
    }

    void add(const std::string& step, std::uint64_t points, std::uint64_t bytes) {
        SetStepReport& taken = report_.steps.emplace_back();
        taken.step = step;
        taken.points = points;
        taken.bytes = bytes;
    }

    void collectSeconds() {
        for (SetStepReport& each : report_.steps)
            for (const auto& [stage, seconds] : progress_.seconds())
                if (stage == each.step) each.seconds = seconds;
        report_.seconds_total = progress_.totalSeconds();
    }

    const BakeOptions& options_;
    const SetRequest request_;
    const std::string work_;
    BakeProgress progress_;
    SetReport report_;
};

} // namespace

SetReport bakeSet(const BakeOptions& options) {
    requirePossible(requestOf(options));
    checkStats(options);
    const tbb::global_control threads(tbb::global_control::max_allowed_parallelism, threadCount(options));
    return SetBake(options).run();
}

} // namespace pointrt

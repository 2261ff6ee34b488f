// SPDX-License-Identifier: GPL-3.0-or-later
#include "preprocess/app/bake_set.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/file.h>
#include <tbb/global_control.h>
#include <unistd.h>

#include <algorithm>
#include <filesystem>
#include <nlohmann/json.hpp>

#include "format/base/error.h"
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

/// Of a set's bake in percent, as measured on lidar.
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

/// Of one process at a time, as long as it lives: two that plan or split one set would write into each other's files.
class Lock {
public:
    explicit Lock(const std::string& work) : descriptor_(::open(work.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC)) {
        if (descriptor_ >= 0 && ::flock(descriptor_, LOCK_EX | LOCK_NB) != 0)
            throw Error(ExitCode::kCannotWrite, work + ": another process is at it");
    }
    ~Lock() {
        if (descriptor_ >= 0) ::close(descriptor_);
    }
    Lock(const Lock&) = delete;
    Lock& operator=(const Lock&) = delete;

private:
    int descriptor_;
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
        sayThatWorkStays();
        if (does(SetStep::kPlan) || does(SetStep::kSplit)) {
            makeFolder(work_);
            const Lock lock(work_);
            try {
                plan();
            } catch (...) {
                std::error_code failure;
                fs::remove(work_, failure); // which it does of an empty folder
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
        takeTimes();
        return std::move(report_);
    }

private:
    void checkOutput() const {
        if (!fs::exists(options_.output)) return;
        if (fs::is_directory(options_.output) && fs::is_empty(options_.output)) return; // engines make it ahead
        const bool is_set = fs::is_directory(options_.output) && fs::exists(options_.output + "/set.json");
        if (!is_set) throw Error(ExitCode::kCannotWrite, options_.output + ": is there, and is no tile set");
        if (!options_.force)
            throw Error(ExitCode::kCannotWrite, options_.output + ": is there already; --force overwrites it");
    }

    /// The plan that is there, of the same request.
    void openPlan() {
        report_.plan = readPlan(work_);
        requireSameRequest(report_.plan, request_);
        report_.plan.output = options_.output;
        report_.plan.bake = request_.bake;
    }

    void requireSplit() const {
        if (!isSplit(report_.plan))
            throw Error(ExitCode::kBadInput, work_ + ": the step split has not been done, or not to its end");
    }

    bool does(SetStep step) const { return options_.tiles.step == SetStep::kAll || options_.tiles.step == step; }

    void requireBlock() const {
        const std::uint32_t blocks = report_.plan.blocks();
        if (options_.tiles.block < blocks) return;
        throw Error(ExitCode::kBadUsage, fmt::format("--step: there is no block {}: {} has blocks 0 to {}",
                                                     options_.tiles.block, work_, blocks - 1));
    }

    /// The plan, but for where the set is made.
    SetPlan making() const {
        SetPlan plan = report_.plan;
        plan.output = finishedFolder(work_);
        return plan;
    }

    std::string metadata() const { return nlohmann::ordered_json{{"writer", "pointrt-bake " POINTRT_VERSION}}.dump(); }

    /// Whether there is a plan to go on with. With --force one of other options or inputs gives way.
    bool goesOn() {
        if (!fs::exists(planFile(work_))) return false;
        try {
            openPlan();
            requireSameInputs(report_.plan, options_.inputs);
            if (!isSplit(report_.plan)) requireUnwritten(report_.plan, options_.inputs); // which are read once more
            return true;
        } catch (const Error&) {
            if (!options_.force) throw;
        }
        beginAnew();
        return false;
    }

    /// The plan goes last: what was done by it would be taken for the next one's.
    void beginAnew() const {
        const std::string plan = planFile(work_);
        for (const fs::directory_entry& entry : fs::directory_iterator(work_))
            if (entry.path() != plan) removeTree(entry.path());
        removeTree(plan);
    }

    void plan() {
        const bool goes_on = goesOn();
        if (!goes_on) {
            progress_.begin("plan", 0);
            report_.plan = makePlan(request_, [&](const ReadStatus& status) { showReading(status); });
            requireSpace(report_.plan);
            writePlan(report_.plan);
            add("plan", report_.plan.points_read, fs::file_size(planFile(work_)));
        }
        const SetPlan& plan = report_.plan;
        if (!goes_on)
            for (const Note& note : plan.notes) progress_.note(noteLine(note));
        progress_.note(fmt::format("{}{} points in {} tiles, {} blocks; {}", goes_on ? "goes on: " : "", plan.points,
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

    /// The block asked for, or all.
    BlockRange blocksAsked() const {
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
        const BlockRange asked = blocksAsked();
        const std::uint64_t points = pointsOf(asked);
        progress_.begin("block", points);
        const TileCounts counts = bakeBlocks(report_.plan, asked, threadCount(options_),
                                             [&](const char*, double share) { progress_.update(share); });
        report_.points_lacking_neighbors = counts.lacking;
        add("block", points, 0);
        dropBuckets();
        if (report_.points_lacking_neighbors > 0)
            progress_.note(fmt::format("{} points lie so far apart that not all of their neighbors in other tiles were "
                                       "read: normals there may differ from those of one file",
                                       report_.points_lacking_neighbors));
    }

    void tiles() {
        const BlockRange blocks = blocksAsked();
        const std::uint64_t points = pointsOf(blocks);
        progress_.begin("tile", points);
        makeBlockTiles(making(), blocks, metadata(), threadCount(options_),
                       [&](const char*, double share) { progress_.update(share); });
        add("tile", points, 0);
    }

    void dropBuckets() const {
        if (!request_.bake.drop_work) return;
        writeMark(blocksMark(report_.plan));
        std::error_code failure; // what cannot be taken away is in nobody's way
        fs::remove_all(bucketsFolder(report_.plan), failure);
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
        const TileSet set = makeSet(making(), metadata(), threadCount(options_),
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

    void takeTimes() {
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

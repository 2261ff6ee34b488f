// SPDX-License-Identifier: Apache-2.0
#include "runtime/window/edit/tile_job.h"

#include <utility>

namespace pointrt {
namespace {

/// Size of a step's files: 0.2 seconds from the page cache, two from a slow disk.
constexpr std::uint64_t kStepBytes = 64 << 20;
/// Time limit of a step, because the camera may have moved on: a tile without an index takes a second or more.
constexpr double kStep_s = 0.5;
/// A level has four times as many splats as the next coarser one, so a step is about a level.
constexpr double kStepShare = 0.25;
constexpr double kLeastShare = kStepShare * kStepShare * kStepShare;

std::size_t tilesOf(const std::vector<OpenedSet>& sets) {
    std::size_t tiles = 0;
    for (const OpenedSet& set : sets) tiles += set.cut.tiles.size();
    return tiles;
}

} // namespace

bool chooseNextCut(TileLoadRequest& request) {
    double share = 1;
    for (; share >= kLeastShare; share *= kStepShare) {
        const std::uint64_t missing = chooseTiles(request, share);
        if (missing == 0 && share < 1) {
            share /= kStepShare;
            chooseTiles(request, share);
            return share >= 1;
        }
        if (missing <= kStepBytes) return share >= 1;
    }
    return false;
}

TileJob::TileJob(Device& device, TileLoadRequest request)
    : worker_(device), loaded_{device, {}},
      job_("Loading tiles", [this, request = std::move(request)](JobControl&) { work(request); }) {}

void TileJob::work(TileLoadRequest request) {
    chooseTiles(request);
    target_tiles_ = tilesOf(request.sets);
    is_final_step_ = chooseNextCut(request);
    request.on_all_cores = false; // the window needs the other cores
    request.time_limit_s = kStep_s;
    loaded_.tiles = loadTiles(worker_.get(), std::move(request));
    is_final_step_ &= loaded_.tiles.complete;
}

LoadedTiles TileJob::take() { return std::exchange(loaded_.tiles, {}); }

} // namespace pointrt

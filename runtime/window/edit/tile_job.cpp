// SPDX-License-Identifier: Apache-2.0
#include "runtime/window/edit/tile_job.h"

#include <utility>

namespace pointrt {
namespace {

/// A step's files: a fifth of a second from memory, two from a slow disk.
constexpr std::uint64_t kStepBytes = 64 << 20;
/// So long it goes on to load tiles that the camera may be past: those without an index take a second or more each.
constexpr double kStep_s = 0.5;
/// Levels have four times as many splats as the next coarser one: so a step is about a level.
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
    request.on_all_cores = false; // the window has work for the others
    request.time_limit_s = kStep_s;
    loaded_.tiles = loadTiles(worker_.get(), std::move(request));
    is_final_step_ &= loaded_.tiles.complete;
}

LoadedTiles TileJob::take() { return std::exchange(loaded_.tiles, {}); }

} // namespace pointrt

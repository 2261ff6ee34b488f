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

bool chooseStep(TileOrder& order) {
    double share = 1;
    for (; share >= kLeastShare; share *= kStepShare) {
        const std::uint64_t missing = chooseTiles(order, share);
        if (missing == 0 && share < 1) {
            share /= kStepShare;
            chooseTiles(order, share);
            return share >= 1;
        }
        if (missing <= kStepBytes) return share >= 1;
    }
    return false;
}

TileJob::TileJob(Device& device, TileOrder order)
    : worker_(device), kept_{device, {}},
      job_("Loading tiles", [this, order = std::move(order)](JobControl&) { work(order); }) {}

void TileJob::work(TileOrder order) {
    chooseTiles(order);
    wanted_ = tilesOf(order.sets);
    last_ = chooseStep(order);
    order.on_all_cores = false; // the window has work for the others
    order.seconds = kStep_s;
    kept_.tiles = loadTiles(worker_.get(), std::move(order));
    last_ &= kept_.tiles.whole;
}

TileDelivery TileJob::take() { return std::exchange(kept_.tiles, {}); }

} // namespace pointrt

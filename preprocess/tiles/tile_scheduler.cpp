// SPDX-License-Identifier: GPL-3.0-or-later
#include "preprocess/tiles/tile_scheduler.h"

#include <algorithm>
#include <atomic>
#include <thread>

#include "format/base/parallel.h"

namespace pointrt {

namespace {

/// A tenth of the work on a tile is serial: two tiles keep two cores busy, and half as many tiles as cores keep all of
/// them busy.
std::size_t lanesFor(std::size_t threads) { return threads < 2 ? 1 : std::max<std::size_t>(2, threads / 2); }

} // namespace

PointBudget::Reservation PointBudget::reserve(std::uint64_t points) {
    const std::uint64_t part = std::min(points, all_);
    std::unique_lock lock(mutex_);
    released_.wait(lock, [&] { return free_ >= part; });
    free_ -= part;
    return {*this, part};
}

void PointBudget::release(std::uint64_t points) {
    {
        const std::lock_guard lock(mutex_);
        free_ += points;
    }
    released_.notify_all();
}

void forTiles(std::size_t count, std::size_t threads, const char* stage, const StageProgress& progress,
              const std::function<void(std::size_t)>& work) {
    const std::thread::id caller = std::this_thread::get_id();
    std::atomic<std::size_t> done{0};
    forAll(
        count,
        [&](std::size_t k) {
            work(k);
            const std::size_t so_far = ++done;
            if (progress && std::this_thread::get_id() == caller) progress(stage, double(so_far) / double(count));
        },
        lanesFor(threads));
    if (progress) progress(stage, 1);
}

} // namespace pointrt

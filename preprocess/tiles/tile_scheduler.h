// SPDX-License-Identifier: GPL-3.0-or-later
// Processes several tiles at once, so that serial parts of a tile's work leave no core idle.
#pragma once

#include <condition_variable>
#include <cstdint>
#include <functional>
#include <mutex>
#include <utility>

#include "preprocess/cloud/stage_progress.h"

namespace pointrt {

/// A memory budget in points. A thread that reserves more than is free waits; a thread that holds a reservation must
/// not make another.
class PointBudget {
public:
    explicit PointBudget(std::uint64_t points) : all_(points), free_(points) {}

    /// A reserved part of the budget, released on destruction.
    class Reservation {
    public:
        Reservation(PointBudget& budget, std::uint64_t points) : budget_(&budget), points_(points) {}
        Reservation(Reservation&& other) noexcept : budget_(other.budget_), points_(std::exchange(other.points_, 0)) {}
        Reservation& operator=(Reservation&&) = delete;
        ~Reservation() { budget_->release(points_); }

    private:
        PointBudget* budget_;
        std::uint64_t points_;
    };

    /// Waits until that many points are free. A request above the budget waits for the whole budget.
    Reservation reserve(std::uint64_t points);

private:
    void release(std::uint64_t points);

    std::mutex mutex_;
    std::condition_variable released_;
    const std::uint64_t all_;
    std::uint64_t free_;
};

/// Runs work(k) for k in [0, count), in any order, some at once; rethrows the first exception.
/// @param threads that the work may use in all
/// @param progress called with the stage from the calling thread
void forTiles(std::size_t count, std::size_t threads, const char* stage, const StageProgress& progress,
              const std::function<void(std::size_t)>& work);

} // namespace pointrt

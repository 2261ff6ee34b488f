// SPDX-License-Identifier: GPL-3.0-or-later
// Several tiles at once, so that what of a tile's work one core does leaves none idle.
#pragma once

#include <condition_variable>
#include <cstdint>
#include <functional>
#include <mutex>
#include <utility>

#include "preprocess/cloud/stage_progress.h"

namespace pointrt {

/// Memory as the points that can be worked on at once; those who ask for more than is free wait. Threads that hold a
/// share must not ask for another.
class PointRoom {
public:
    explicit PointRoom(std::uint64_t points) : all_(points), free_(points) {}

    /// A part of the room, until it is destroyed.
    class Share {
    public:
        Share(PointRoom& room, std::uint64_t points) : room_(&room), points_(points) {}
        Share(Share&& other) noexcept : room_(other.room_), points_(std::exchange(other.points_, 0)) {}
        Share& operator=(Share&&) = delete;
        ~Share() { room_->giveBack(points_); }

    private:
        PointRoom* room_;
        std::uint64_t points_;
    };

    /// Waits until there is room. Who asks for more than all of it has it alone.
    Share take(std::uint64_t points);

private:
    void giveBack(std::uint64_t points);

    std::mutex mutex_;
    std::condition_variable given_back_;
    const std::uint64_t all_;
    std::uint64_t free_;
};

/// Runs work(k) for k in [0, count), in any order, some at once; rethrows the first exception.
/// @param threads that the work itself may use, in all
/// @param progress hears of the stage, from the calling thread
void forTiles(std::size_t count, std::size_t threads, const char* stage, const StageProgress& progress,
              const std::function<void(std::size_t)>& work);

} // namespace pointrt

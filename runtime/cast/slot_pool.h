// SPDX-License-Identifier: Apache-2.0
// A pool of cast slots for the threads that trace rays in a scene.
#pragma once

#include <condition_variable>
#include <cstddef>
#include <functional>
#include <mutex>
#include <vector>

#include "runtime/cast/cast_slot.h"

namespace pointrt {

/// Thread-safe.
class SlotPool {
public:
    /// @param create is called if all slots are in use and there are fewer than `most`
    SlotPool(std::size_t most, std::function<CastSlot()> create) : most_(most), create_(std::move(create)) {}
    ~SlotPool();
    SlotPool(const SlotPool&) = delete;
    SlotPool& operator=(const SlotPool&) = delete;

    /// Calls work(slot) with a slot for exclusive use; waits if all are in use.
    template <typename Work>
    void with(const Work& work) {
        Loan loan{*this, take()};
        work(loan.slot);
    }

    std::size_t most() const { return most_; }

private:
    struct Loan {
        SlotPool& pool;
        CastSlot slot;
        ~Loan() { pool.release(std::move(slot)); }
    };
    CastSlot take();
    void release(CastSlot slot);

    std::size_t most_, made_ = 0;
    std::function<CastSlot()> create_;
    std::mutex mutex_;
    std::condition_variable returned_;
    std::vector<CastSlot> idle_;
};

} // namespace pointrt

// SPDX-License-Identifier: Apache-2.0
// The slots of a scene, lent to whoever has rays for them.
#pragma once

#include <condition_variable>
#include <cstddef>
#include <functional>
#include <mutex>
#include <vector>

#include "runtime/cast/cast_slot.h"

namespace pointrt {

/// Threads may use it at the same time.
class SlotPool {
public:
    /// @param create called for a slot that is asked for while all are lent, until there are most of them
    SlotPool(std::size_t most, std::function<CastSlot()> create) : most_(most), create_(std::move(create)) {}
    ~SlotPool();
    SlotPool(const SlotPool&) = delete;
    SlotPool& operator=(const SlotPool&) = delete;

    /// Runs work(slot) with a slot that nobody else has, and waits for one where all are lent.
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
        ~Loan() { pool.giveBack(std::move(slot)); }
    };
    CastSlot take();
    void giveBack(CastSlot slot);

    std::size_t most_, made_ = 0;
    std::function<CastSlot()> create_;
    std::mutex mutex_;
    std::condition_variable returned_;
    std::vector<CastSlot> idle_;
};

} // namespace pointrt

// SPDX-License-Identifier: Apache-2.0
#include "runtime/cast/slot_pool.h"

#include <utility>

namespace pointrt {

SlotPool::~SlotPool() {
    for (CastSlot& slot : idle_) destroySlot(slot);
}

CastSlot SlotPool::take() {
    std::unique_lock lock(mutex_);
    returned_.wait(lock, [&] { return !idle_.empty() || made_ < most_; });
    if (idle_.empty()) {
        CastSlot slot = create_(); // under the lock: other threads wait for a slot anyway
        ++made_;
        idle_.reserve(made_); // so that release never fails
        return slot;
    }
    CastSlot slot = std::move(idle_.back());
    idle_.pop_back();
    return slot;
}

void SlotPool::release(CastSlot slot) {
    {
        const std::lock_guard lock(mutex_);
        idle_.push_back(std::move(slot));
    }
    returned_.notify_one();
}

} // namespace pointrt

// SPDX-License-Identifier: GPL-3.0-or-later
// Progress of parallel tasks.
#pragma once

#include <mutex>

#include "preprocess/octree/octree.h"

namespace pointrt {

class TaskProgress {
public:
    /// @param progress may be empty
    TaskProgress(const OctreeProgress& progress, std::size_t tasks) : progress_(progress), tasks_(tasks) {}

    /// Reports one more finished task; serialises the calls of progress.
    void finishOne() {
        if (!progress_) return;
        const std::lock_guard lock(mutex_);
        progress_(static_cast<double>(++done_) / static_cast<double>(tasks_));
    }

private:
    const OctreeProgress& progress_;
    const std::size_t tasks_;
    std::mutex mutex_;
    std::size_t done_ = 0;
};

} // namespace pointrt

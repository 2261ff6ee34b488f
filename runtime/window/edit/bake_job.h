// SPDX-License-Identifier: Apache-2.0
// Bakes scans in the background.
#pragma once

#include <cstdint>
#include <string>

#include "runtime/session/bake_cache.h"
#include "runtime/session/find_tool.h"
#include "runtime/window/edit/job.h"

namespace pointrt {

/// Whether to bake all points, or only a tenth of them to show something quickly.
enum class BakeDetail : std::uint8_t { kAll, kQuick };

/// Runs bakeCached. Leaves no partial file when cancelled: pointrt-bake gets SIGTERM, and SIGKILL after three seconds.
/// If pointrt-bake is already writing its output, the output is completed.
class BakeJob {
public:
    explicit BakeJob(const ScanBake& bake, BakeDetail detail = BakeDetail::kAll,
                     const FileCache& cache = userBakeCache(), const std::string& tool = findTool(kBakeTool));

    Job& job() { return job_; }
    const Job& job() const { return job_; }
    /// The .pro in the cache, once the job is done.
    const std::string& output() const { return output_; }
    /// Whether the output is a quick bake. Cached and small scans are never baked quickly.
    bool isQuick() const { return is_quick_; }

private:
    std::string output_; ///< owned by the thread until the job has ended, like is_quick_
    bool is_quick_ = false;
    Job job_;
};

} // namespace pointrt

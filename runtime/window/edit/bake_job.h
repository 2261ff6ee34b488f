// SPDX-License-Identifier: Apache-2.0
// Bakes scans in the background.
#pragma once

#include <string>

#include "runtime/session/bake_cache.h"
#include "runtime/session/bake_tool.h"
#include "runtime/window/edit/job.h"

namespace pointrt {

/// Runs bakeCached. Leaves no partial file when cancelled: pointrt-bake gets SIGTERM, and SIGKILL after three seconds;
/// if it is already writing its output, it finishes it.
class BakeJob {
public:
    explicit BakeJob(const ScanBake& bake, const FileCache& cache = userBakeCache(),
                     const std::string& tool = findBakeTool());

    Job& job() { return job_; }
    const Job& job() const { return job_; }
    /// The .pro in the cache, once the job is done.
    const std::string& output() const { return output_; }

private:
    std::string output_; ///< owned by the thread until the job has ended
    Job job_;
};

} // namespace pointrt

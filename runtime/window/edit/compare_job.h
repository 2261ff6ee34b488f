// SPDX-License-Identifier: Apache-2.0
// Compares scans in the background.
#pragma once

#include <string>

#include "runtime/session/bake_cache.h"
#include "runtime/session/find_tool.h"
#include "runtime/window/edit/job.h"

namespace pointrt {

/// Whether distances from other scans can be computed for a scan: not for tile sets and Gaussians.
bool mayCompare(const InstanceDescription& scan);

/// Runs pointrt-rays compare: the distances of the compared scan's splats from the reference's surface become an
/// attribute of a copy of the compared scan.
class CompareJob {
public:
    CompareJob(const SceneDescription& scene, const Comparison& comparison, const std::string& device,
               const FileCache& cache = userBakeCache(), const std::string& tool = findTool(kRaysTool));

    Job& job() { return job_; }
    const Job& job() const { return job_; }
    /// The copy, a .pro in the cache, once the job is done.
    const std::string& output() const { return output_; }

private:
    std::string output_; ///< owned by the thread until the job has ended
    Job job_;
};

} // namespace pointrt

// SPDX-License-Identifier: Apache-2.0
// Renders a picture of any size in the background.
#pragma once

#include <string>
#include <vector>

#include "runtime/window/edit/job.h"
#include "runtime/window/edit/workspace.h"

namespace pointrt {

class StillJob {
public:
    StillJob(const Still& still, const std::string& device);

    Job& job() { return job_; }
    const Job& job() const { return job_; }

private:
    Job job_;
};

/// "statue-still-1.png" for statue.ply, in the current folder, with the first number that neither a file nor a waiting
/// still uses.
std::string freeStillName(const std::string& scene, const std::vector<Still>& waiting);

} // namespace pointrt

// SPDX-License-Identifier: Apache-2.0
// Runs pointrt-bake in the background.
#pragma once

#include <string>

#include "runtime/window/edit/bake_plan.h"
#include "runtime/window/edit/job.h"

namespace pointrt {

/// Runs baker -o plan.output on plan.inputs. Leaves no partial file when cancelled: pointrt-bake gets SIGTERM, and
/// SIGKILL after three seconds; if it is already writing its output, it finishes it.
class BakeJob {
public:
    explicit BakeJob(const BakePlan& plan, const std::string& baker = findBakeTool());

    Job& job() { return job_; }
    const Job& job() const { return job_; }
    /// The .pro, complete once the job is done.
    const std::string& output() const { return output_; }

private:
    const std::string output_;
    Job job_;
};

/// Parses a line "progress SHARE STAGE RATE" of pointrt-bake --progress lines into control. Returns false for any other
/// line.
bool parseBakeProgress(const std::string& line, JobControl& control);

} // namespace pointrt

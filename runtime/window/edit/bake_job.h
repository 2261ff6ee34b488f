// SPDX-License-Identifier: Apache-2.0
// pointrt-bake at work behind the window.
#pragma once

#include <string>

#include "runtime/window/edit/bake_plan.h"
#include "runtime/window/edit/job.h"

namespace pointrt {

/// Runs baker -o plan.output on plan.inputs. Cancelled, it leaves nothing half-written: pointrt-bake is asked to end
/// (SIGTERM) and made to after three seconds; one that was writing its file by then finishes it.
class BakeJob {
public:
    explicit BakeJob(const BakePlan& plan, const std::string& baker = findBakeTool());

    Job& job() { return job_; }
    const Job& job() const { return job_; }
    /// The .pro, which is there once the job is done.
    const std::string& output() const { return output_; }

private:
    const std::string output_;
    Job job_;
};

/// A line "progress SHARE STAGE RATE" of pointrt-bake --progress lines, told to control; false where it is no such
/// line.
bool parseBakeProgress(const std::string& line, JobControl& control);

} // namespace pointrt

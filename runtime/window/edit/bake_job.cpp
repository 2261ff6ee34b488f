// SPDX-License-Identifier: Apache-2.0
#include "runtime/window/edit/bake_job.h"

namespace pointrt {

BakeJob::BakeJob(const ScanBake& bake, const FileCache& cache, const std::string& tool)
    : job_("Baking " + describeScans(bake.scans), [this, bake, cache, tool](JobControl& control) {
          const BakeMonitor monitor{[&] { return control.cancelled(); },
                                    [&](double share, const std::string& stage) {
                                        control.setDetail(stage);
                                        control.setProgress(share);
                                    },
                                    {}};
          output_ = bakeCached(cache, bake, tool, monitor);
          if (output_.empty()) throw JobCancelled{};
      }) {}

} // namespace pointrt

// SPDX-License-Identifier: Apache-2.0
#include "runtime/window/edit/bake_job.h"

#include <optional>

namespace pointrt {
namespace {

std::string titleOf(const ScanBake& bake, BakeDetail detail) {
    return (detail == BakeDetail::kQuick ? "Reading " : "Baking ") + describeScans(bake.scans);
}

} // namespace

BakeJob::BakeJob(const ScanBake& bake, BakeDetail detail, const FileCache& cache, const std::string& tool)
    : job_(titleOf(bake, detail), [this, bake, detail, cache, tool](JobControl& control) {
          const BakeMonitor monitor{[&] { return control.cancelled(); },
                                    [&](double share, const std::string& stage) {
                                        control.setDetail(stage);
                                        control.setProgress(share);
                                    },
                                    {}};
          std::optional<ScanBake> quick;
          if (detail == BakeDetail::kQuick) {
              output_ = findBake(cache, bake, tool, monitor);
              quick = quickBake(bake);
          }
          is_quick_ = output_.empty() && quick;
          if (output_.empty()) output_ = bakeCached(cache, quick.value_or(bake), tool, monitor);
          if (output_.empty()) throw JobCancelled{};
      }) {}

} // namespace pointrt

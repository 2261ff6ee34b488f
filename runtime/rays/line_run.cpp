// SPDX-License-Identifier: Apache-2.0
#include "runtime/rays/line_run.h"

#include "format/base/report_file.h"
#include "runtime/rays/run_report.h"

namespace pointrt {

void reportRun(const CommonOptions& options, const LineRun& run) {
    if (options.verbose) printNote(options, std::to_string(run.lines) + " lines on " + run.device);
    if (options.stats.empty()) return;
    writeReport(
        options.stats,
        reportText(run.device, {{"lines", run.lines}},
                   {{"open", run.open_s}, {"cast", run.cast_s}, {"write", run.write_s}, {"total", run.total_s}}));
}

} // namespace pointrt

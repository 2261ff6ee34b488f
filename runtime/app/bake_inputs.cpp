// SPDX-License-Identifier: Apache-2.0
#include "runtime/app/bake_inputs.h"

#include <cstdio>

#include "format/os/interrupt.h"
#include "runtime/session/bake_cache.h"
#include "runtime/session/find_tool.h"
#include "runtime/util/render_progress.h"

namespace pointrt {

bool bakeInputs(Options& options) {
    if (isScene(options.inputs.front())) return true;
    catchInterrupts();
    const std::string doing = "baking " + describeScans(options.inputs) + ",";
    RenderProgress progress(options.quiet, options.verbose, options.progress_lines, doing.c_str());
    BakeMonitor monitor;
    monitor.cancelled = interrupted;
    monitor.progress = [&](double share, const std::string& stage) { progress.update(share, stage); };
    if (!options.quiet)
        monitor.remark = [&](const std::string& line) {
            progress.finish();
            std::fprintf(stderr, "%s\n", line.c_str());
        };
    options.source = options.inputs.front();
    options.scene = bakeCached(userBakeCache(), {options.inputs, options.bake_options}, findTool(kBakeTool), monitor);
    progress.finish();
    return !options.scene.empty();
}

} // namespace pointrt

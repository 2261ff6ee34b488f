// SPDX-License-Identifier: GPL-3.0-or-later
#include <cstdio>

#include "format/base/printable.h"
#include "format/base/run_tool.h"
#include "format/os/heap.h"
#include "format/os/process.h"
#include "preprocess/app/bake.h"
#include "preprocess/app/bake_set.h"
#include "preprocess/app/interrupt.h"
#include "preprocess/app/summary.h"

namespace {

template <typename Report>
void report(const pointrt::BakeOptions& options, const Report& result) {
    if (options.verbosity != pointrt::Verbosity::kQuiet)
        std::fprintf(stderr, "%s: %s\n", pointrt::printable(options.output, std::string::npos).c_str(),
                     summaryLine(result).c_str());
    if (!options.stats_path.empty()) writeStats(result, options.stats_path);
}

} // namespace

int main(int argc, char** argv) {
    using namespace pointrt;
    endProcess(runTool("pointrt-bake", [&] {
        BakeOptions options;
        if (!parseOptions(argc, argv, options)) return static_cast<int>(ExitCode::kDone);
        returnLargeBlocks();
        installInterruptHandlers();
        keepWorkingWithoutReaders();
        if (options.isTileSet())
            report(options, bakeSet(options));
        else
            report(options, bake(options));
        return static_cast<int>(ExitCode::kDone);
    }));
}

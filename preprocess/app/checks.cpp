// SPDX-License-Identifier: GPL-3.0-or-later
#include "preprocess/app/checks.h"

#include "format/base/error.h"
#include "format/base/report_file.h"
#include "format/base/same_file.h"

namespace pointrt {

void requireNoInput(const BakeOptions& options, const std::string& path, const char* option) {
    for (const std::string& input : options.inputs)
        if (isSameFile(path, input))
            throw Error(ExitCode::kBadUsage, path + ": " + option + " would overwrite an input");
}

void checkStats(const BakeOptions& options) {
    const std::string& path = options.stats_path;
    if (path.empty() || path == "-") return;
    requireNoInput(options, path, "--stats");
    if (isSameFile(path, options.output))
        throw Error(ExitCode::kBadUsage, path + ": --stats and --output are the same file");
    requireReportWritable(path);
}

} // namespace pointrt

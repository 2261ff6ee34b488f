// SPDX-License-Identifier: Apache-2.0
#include "runtime/rays/text_output.h"

#include <algorithm>

#include "format/base/error.h"
#include "format/base/report_file.h"

namespace pointrt {

void checkTextOutput(const CommonOptions& options, std::initializer_list<std::string_view> suffixes) {
    if (options.stats == "-") throw Error(ExitCode::kBadUsage, "--stats -: the results are printed there; give a file");
    if (!options.stats.empty()) requireReportWritable(options.stats);
    if (options.output.empty()) return;
    std::string names;
    for (const std::string_view suffix : suffixes) names += (names.empty() ? "" : ", ") + std::string(suffix);
    if (std::ranges::none_of(suffixes, [&](std::string_view suffix) { return options.output.ends_with(suffix); }))
        throw Error(ExitCode::kBadUsage, options.output + ": the suffix is not one of " + names);
    requireReportWritable(options.output);
}

} // namespace pointrt

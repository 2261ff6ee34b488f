// SPDX-License-Identifier: Apache-2.0
// pointrt-rays: what rays meet in scans.
#include <string_view>

#include "format/base/report_file.h"
#include "format/base/run_tool.h"
#include "runtime/rays/cast_job.h"
#include "runtime/rays/cast_options.h"

namespace {

using namespace pointrt;

int run(int argc, const char* const* argv) {
    const std::string_view command = argc > 1 ? argv[1] : "";
    if (command == "--help" || command == "-h" || command == "--version") {
        writeReport("-", command == "--version" ? "pointrt-rays " POINTRT_VERSION "\n" : raysHelp());
        return 0;
    }
    if (command != "cast")
        throw Error(ExitCode::kBadUsage, command.empty() ? "a command is missing: cast"
                                                         : std::string(command) + ": no command; there is cast");
    CastOptions options;
    if (const auto done = parseCastOptions(argc - 1, argv + 1, options)) return *done;
    runCast(options);
    return 0;
}

} // namespace

int main(int argc, char** argv) {
    return pointrt::runTool("pointrt-rays", [&] { return run(argc, argv); });
}

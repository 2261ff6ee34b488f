// SPDX-License-Identifier: Apache-2.0
// pointrt-rays: what rays meet in scans.
#include <string_view>

#include "format/base/report_file.h"
#include "format/base/run_tool.h"
#include "runtime/rays/cast_job.h"
#include "runtime/rays/command/command_table.h"
#include "runtime/rays/lidar/lidar_job.h"
#include "runtime/rays/study/sun_command.h"
#include "runtime/rays/study/viewshed_command.h"

namespace {

using namespace pointrt;

constexpr RayCommand kCommands[] = {
    {"cast", "first hits, or occlusion, of any rays", castCommand},
    {"lidar", "what a laser scanner would measure", lidarCommand},
    {"sun", "hours of direct sun on points, and how much of the sky they see", sunCommand},
    {"viewshed", "which points observers see", viewshedCommand},
};

int run(int argc, const char* const* argv) {
    const std::string_view command = argc > 1 ? argv[1] : "";
    if (command == "--help" || command == "-h" || command == "--version") {
        writeReport("-", command == "--version" ? "pointrt-rays " POINTRT_VERSION "\n" : commandHelp(kCommands));
        return 0;
    }
    return commandNamed(kCommands, command).run(argc - 1, argv + 1);
}

} // namespace

int main(int argc, char** argv) {
    return pointrt::runTool("pointrt-rays", [&] { return run(argc, argv); });
}

// SPDX-License-Identifier: Apache-2.0
// pointrt-rays: casts rays at point scans.
#include <string_view>

#include "format/base/report_file.h"
#include "format/base/run_tool.h"
#include "format/cli/command_line.h"
#include "runtime/rays/cast_job.h"
#include "runtime/rays/cast_options.h"
#include "runtime/rays/command_table.h"
#include "runtime/rays/compare_command.h"
#include "runtime/rays/contours_command.h"
#include "runtime/rays/lidar_job.h"
#include "runtime/rays/lidar_options.h"
#include "runtime/rays/measure_command.h"
#include "runtime/rays/profile_command.h"
#include "runtime/rays/section_command.h"
#include "runtime/rays/sun_command.h"
#include "runtime/rays/viewshed_command.h"

namespace {

using namespace pointrt;

constexpr RayCommand kCommands[] = {
    {"cast", "first hits or occlusion of given rays", castCommand, castText},
    {"compare", "signed distances between two scans", compareCommand, compareText},
    {"contours", "lines of equal height", contoursCommand, contoursText},
    {"lidar", "simulates a laser scanner", lidarCommand, lidarText},
    {"measure", "distances, angles, areas, volumes, circles and spheres", measureCommand, measureText},
    {"profile", "the surface along a line", profileCommand, profileText},
    {"section", "lines in which planes cut surfaces", sectionCommand, sectionText},
    {"sun", "hours of direct sun and sky view of points", sunCommand, sunText},
    {"viewshed", "points visible to observers", viewshedCommand, viewshedText},
};

/// The output of an option given instead of a command; empty if the tool has no such option.
std::string answer(std::string_view option, const char* value) {
    if (option == "--version") return "pointrt-rays " POINTRT_VERSION "\n";
    if (option == "--help" || option == "-h") return helpText(toolText(kCommands, POINTRT_VERSION));
    return option == "--generate" ? generatedText(toolText(kCommands, POINTRT_VERSION), value ? value : "") : "";
}

int run(int argc, const char* const* argv) {
    const std::string_view command = argc > 1 ? argv[1] : "";
    const std::string text = answer(command, argc > 2 ? argv[2] : nullptr);
    if (text.empty()) return commandNamed(kCommands, command).run(argc - 1, argv + 1);
    writeReport("-", text);
    return 0;
}

} // namespace

int main(int argc, char** argv) {
    return pointrt::runTool("pointrt-rays", [&] { return run(argc, argv); });
}

// SPDX-License-Identifier: Apache-2.0
#include "runtime/rays/viewshed_command.h"

#include <algorithm>
#include <limits>

#include "format/base/error.h"
#include "format/cli/command_line.h"
#include "runtime/rays/study_run.h"
#include "runtime/util/parse.h"

namespace pointrt {
namespace {

constexpr const char* kViewshedName = "pointrt-rays viewshed";
constexpr const char* kViewshedAbout = "Computes which points observers see, and how many observers see each.";
constexpr const char* kViewshedExamples =
    "  pointrt-rays viewshed site.pro --from 2600010,1200020,480 -o seen.laz\n"
    "  pointrt-rays viewshed site.pro --from 10,20,0 --from 40,25,0 --height 1.7 --radius 500 -o seen.ply\n";
constexpr const char* kViewshedNotes =
    "Columns: seen_by (number of observers that see the point), and observer_0, observer_1 ... (1 if that observer\n"
    "does). An observer inside a wall or below the ground sees nothing; raise it with --height.";
/// LAS describes extra bytes in a record of at most 65,535 bytes, 192 per column: 341 columns, some of which are the
/// scan's.
constexpr std::size_t kMostObservers = 255;

struct ViewshedOptions : StudyOptions {
    std::vector<std::array<double, 3>> from;
    double height = 0, radius = std::numeric_limits<double>::infinity();
};

void addOptions(CommandLine& app, ViewshedOptions& options) {
    constexpr double kFarthest = 1e30; // the limit of coordinates in .pro files
    addStudyOptions(app, options);
    addValue(
        app, "--from", "X,Y,Z",
        "Position of an observer in the scan's coordinates; repeat the option for more observers, which are numbered "
        "from 0",
        [&](const std::string& text) { options.from.push_back(parseTriple(text)); }, true, true);
    addValue(app, "--height", "H", "Height of observers above --from, in the scan's unit (default 0)",
             [&](const std::string& text) { options.height = parseReal(text, -kFarthest, kFarthest); });
    addValue(app, "--radius", "R", "Maximum viewing distance, in the scan's unit (default inf)",
             [&](const std::string& text) { options.radius = parseRealAbove(text, 0, kFarthest); });
    addDeviceAndReport(app, options);
    addCommonOptions(app, POINTRT_VERSION, kWrongInput, kViewshedExamples, kViewshedNotes);
}

void checkOptions(const ViewshedOptions& options) {
    checkStudyOptions(options);
    if (options.from.size() > kMostObservers)
        throw Error(ExitCode::kBadUsage,
                    "--from: " + std::to_string(options.from.size()) + " observers, but at most 255 are possible");
}

std::vector<PointColumn> resultColumns(std::size_t observers) {
    std::vector<PointColumn> columns{{"seen_by", PRO_TYPE_U8}};
    for (std::size_t k = 0; k < observers; ++k) columns.push_back({"observer_" + std::to_string(k), PRO_TYPE_U8});
    return columns;
}

void printSummary(const ViewshedOptions& options, const std::vector<std::uint64_t>& seen, std::uint64_t points) {
    for (std::size_t k = 0; k < seen.size(); ++k)
        printNote(options, "viewshed: observer " + std::to_string(k) + " sees " + std::to_string(seen[k]) + " of " +
                               std::to_string(points) + " points" +
                               (seen[k] == 0 ? ": it may be inside an object; raise it with --height" : ""));
}

void runViewshed(const ViewshedOptions& options) {
    std::vector<Observer> observers;
    std::vector<std::uint64_t> seen(options.from.size());
    std::uint64_t points_done = 0;
    StudyWork work;
    work.results = resultColumns(options.from.size());
    work.begin = [&](OpenStudy& study) {
        for (std::array<double, 3> eye : options.from) {
            for (std::size_t axis = 0; axis < 3; ++axis) eye[axis] += options.height * study.rules.up[axis];
            observers.push_back({eye, options.radius});
        }
    };
    work.block = [&](const OpenStudy& study, const StudyPoints& points, std::size_t count,
                     std::vector<std::vector<std::byte>>& values, const ReportProgress& report) {
        std::uint64_t rays = 0;
        for (std::vector<std::byte>& column : values) column.assign(count, std::byte{0});
        const std::span<std::uint8_t> sums = numbersIn<std::uint8_t>(values[0]);
        for (std::size_t k = 0; k < observers.size(); ++k) {
            const std::span<std::uint8_t> visible = numbersIn<std::uint8_t>(values[k + 1]);
            rays += testSight(study.scene, points, observers[k], study.rules, visible);
            for (std::size_t i = 0; i < count; ++i) {
                sums[i] = static_cast<std::uint8_t>(sums[i] + visible[i]);
                seen[k] += visible[i];
            }
            report(static_cast<double>(k + 1) / static_cast<double>(observers.size()));
        }
        points_done += count;
        return rays;
    };
    runStudy(options, work);
    printSummary(options, seen, points_done);
}

} // namespace

int viewshedCommand(int argc, const char* const* argv) {
    ViewshedOptions options;
    CommandLine app(kViewshedAbout, kViewshedName);
    addOptions(app, options);
    if (const auto done = parseStudyLine(app, argc, argv)) return *done;
    checkOptions(options);
    runViewshed(options);
    return 0;
}

CommandText viewshedText() {
    ViewshedOptions options;
    CommandLine app(kViewshedAbout, kViewshedName);
    addOptions(app, options);
    return describe(app);
}

} // namespace pointrt

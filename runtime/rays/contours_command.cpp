// SPDX-License-Identifier: Apache-2.0
#include "runtime/rays/contours_command.h"

#include "format/base/error.h"
#include "format/base/report_file.h"
#include "format/cli/command_line.h"
#include "runtime/measure/contour_files.h"
#include "runtime/rays/line_run.h"
#include "runtime/rays/open_scene.h"
#include "runtime/rays/run_report.h"
#include "runtime/rays/scene_units.h"
#include "runtime/rays/study_options.h"
#include "runtime/rays/text_output.h"
#include "runtime/studies/plan_frame.h"
#include "runtime/util/parse.h"
#include "runtime/util/vec_array.h"

namespace pointrt {
namespace {

constexpr const char* kContoursName = "pointrt-rays contours";
constexpr const char* kContoursAbout = "Draws contour lines of the surface seen from above.";
constexpr const char* kContoursExamples =
    "  pointrt-rays contours site.pro --interval 0.5 -o contours.dxf\n"
    "  pointrt-rays contours forest.pro --only class=2 --interval 1 --shortest 20 -o ground.geojson\n"
    "  pointrt-rays contours quarry.proset --cell 0.25 -o plan.svg\n";
constexpr const char* kContoursNotes =
    "Vertical rays through the nodes of a raster find the heights of the first surface; contours are interpolated\n"
    "linearly between nodes and end where there is no surface. Every fifth contour is an index contour, which has its\n"
    "own layer in DXF files and labels in SVG files. See\n"
    "docs/RAYS.md.";

struct ContoursOptions : CommonOptions {
    ContourRules rules;
    std::optional<std::array<double, 3>> up;
};

void addOptions(CommandLine& app, ContoursOptions& options) {
    constexpr double kFarthest = 1e30; // the limit of coordinates in .pro files
    addScene(app, options);
    addOutput(app, options,
              "The lines, replacing an existing file: .dxf or .geojson in the scan's coordinates, or .svg, a plan",
              ".dxf .geojson .svg");
    addValue(app, "--interval", "LENGTH",
             "Height difference between contour lines (default: a round number that gives 10 to 25 heights)",
             [&](const std::string& text) { options.rules.interval = parseRealAbove(text, 0, kFarthest); });
    addValue(app, "--cell", "LENGTH",
             "Cell size of the raster of rays (default: a thousandth of the scan's longer side)",
             [&](const std::string& text) { options.rules.cell = parseRealAbove(text, 0, kFarthest); });
    addValue(app, "--shortest", "LENGTH", "Leave out lines shorter than this (default 0)",
             [&](const std::string& text) { options.rules.shortest = parseReal(text, 0, kFarthest); });
    addValue(app, "--up", "X,Y,Z", "Up in the scan's coordinates (default: the scan's up, else +Z)",
             [&](const std::string& text) { options.up = parseTriple(text); });
    addDeviceAndReport(app, options);
    addCommonOptions(app, POINTRT_VERSION, kWrongInput, kContoursExamples, kContoursNotes);
}

std::string fileText(const ContoursOptions& options, const ContourDrawing& drawing) {
    if (options.output.ends_with(".svg")) return contourSvg(drawing);
    return options.output.ends_with(".dxf") ? contourDxf(drawing) : contourGeoJson(drawing);
}

void drawContours(const ContoursOptions& options, LineRun& run) {
    const Position up = upOfScene(options.up, options.scene);
    const PlanFrame plan = planFrame({}, up);
    const SceneUnits units = sceneUnits(options.scene);
    ContourRules rules = options.rules;
    rules.up = up;
    const TraceScene scene = timed(run.open_s, [&] { return openScene(options, run.device); });
    const ContourDrawing drawing{timed(run.cast_s, [&] { return surfaceContours(scene, rules); }),
                                 arrayOf(plan.east),
                                 arrayOf(plan.north),
                                 units.unit,
                                 units.decimals,
                                 units.epsg};
    timed(run.write_s, [&] { writeReport(options.output, fileText(options, drawing)); });
    run.lines = drawing.contours.size();
    if (run.lines == 0)
        printNote(options, "contours: the surface crosses no height that is a multiple of the interval");
}

} // namespace

int contoursCommand(int argc, const char* const* argv) {
    ContoursOptions options;
    CommandLine app(kContoursAbout, kContoursName);
    addOptions(app, options);
    if (const auto done = parseCommandLine(app, argc, argv, {{".dxf", "-o"}, {".geojson", "-o"}, {".svg", "-o"}}))
        return *done;
    checkTextOutput(options, {".dxf", ".geojson", ".svg"});
    checkCommonOptions(options, {}, "contours");
    LineRun run;
    withToolErrors([&] { timed(run.total_s, [&] { drawContours(options, run); }); });
    reportRun(options, run);
    return 0;
}

CommandText contoursText() {
    ContoursOptions options;
    CommandLine app(kContoursAbout, kContoursName);
    addOptions(app, options);
    return describe(app);
}

} // namespace pointrt

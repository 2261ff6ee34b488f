// SPDX-License-Identifier: Apache-2.0
#include "runtime/rays/section_command.h"

#include "format/base/error.h"
#include "format/base/report_file.h"
#include "format/cli/command_line.h"
#include "runtime/measure/section_files.h"
#include "runtime/rays/line_run.h"
#include "runtime/rays/open_scene.h"
#include "runtime/rays/run_report.h"
#include "runtime/rays/scene_units.h"
#include "runtime/rays/study_options.h"
#include "runtime/rays/text_output.h"
#include "runtime/util/parse.h"

namespace pointrt {
namespace {

constexpr const char* kSectionName = "pointrt-rays section";
constexpr const char* kSectionAbout =
    "Draws the lines in which planes cut the surfaces of a scan: floor plans and sections.";
constexpr const char* kSectionExamples =
    "  pointrt-rays section house.pro --height 1.2 -o plan.dxf\n"
    "  pointrt-rays section tower.pro --height 5 --height 10 --height 15 -o floors.geojson\n"
    "  pointrt-rays section hall.pro --plane y=3 --plane 0,0,12,8 --flat -o sections.dxf\n"
    "  pointrt-rays section bridge.proset --plane x=120 --clip 100,0,400,140,60,450 -o pier.svg\n";
constexpr const char* kSectionNotes =
    "Rays sweep each plane along two axes, in both directions and through all surfaces. Layers of .dxf are section_1,\n"
    "section_2 ...: heights first, then planes, each in the order given. Columns of .csv: section, line, x, y, z. See\n"
    "docs/RAYS.md.";

constexpr double kDefaultGap = 6;         ///< steps, which is three times the point spacing
constexpr double kDefaultTolerance = 0.5; ///< steps, which is a quarter of the point spacing

struct SectionOptions : CommonOptions {
    std::vector<double> heights;
    std::vector<std::string> planes;
    std::optional<double> step, gap, tolerance;
    double shortest = 0;
    bool flat = false;
    std::optional<std::array<double, 3>> up;
};

/// The text of a plane, if it is valid for any up direction.
std::string planeText(const std::string& text) {
    try {
        sectionPlane(text, {0, 0, 1});
    } catch (const TraceError& error) {
        throw std::invalid_argument(error.what());
    }
    return text;
}

void addPlanes(CommandLine& app, SectionOptions& options) {
    constexpr double kFarthest = 1e30; // the limit of coordinates in .pro files
    addValue(
        app, "--height", "HEIGHT",
        "Cut horizontally at this height along up: a floor plan. Repeat the option for several heights",
        [&](const std::string& text) { options.heights.push_back(parseReal(text, -kFarthest, kFarthest)); }, false,
        true);
    addValue(
        app, "--plane", "PLANE",
        "Cut along this plane, as pointrt-view --section does: x=3 and y=3 are vertical, with the other coordinate "
        "increasing to the right in drawings; -y=3 is seen from the other side; X0,Y0,X1,Y1 is vertical through two "
        "points, the first one on the left; z=1.2 is horizontal. Repeat the option for several planes",
        [&](const std::string& text) { options.planes.push_back(planeText(text)); }, false, true);
}

void addLengths(CommandLine& app, SectionOptions& options) {
    constexpr double kFarthest = 1e30; // the limit of coordinates in .pro files
    addValue(app, "--step", "LENGTH",
             "Distance between rays; surfaces closer together than two steps become one line (default: the median "
             "radius of the scan's discs, half the point spacing)",
             [&](const std::string& text) { options.step = parseRealAbove(text, 0, kFarthest); });
    addValue(app, "--gap", "LENGTH",
             "Join lines across gaps up to this width (default: 6 steps; never less than 2.5 steps)",
             [&](const std::string& text) { options.gap = parseReal(text, 0, kFarthest); });
    addValue(app, "--tolerance", "LENGTH",
             "Simplify lines, moving them at most this far from the points that rays hit; larger values give fewer "
             "points (default: half a step)",
             [&](const std::string& text) { options.tolerance = parseReal(text, 0, kFarthest); });
    addValue(app, "--shortest", "LENGTH", "Leave out lines shorter than this (default 0)",
             [&](const std::string& text) { options.shortest = parseReal(text, 0, kFarthest); });
}

void addOptions(CommandLine& app, SectionOptions& options) {
    addScene(app, options);
    addOutput(app, options,
              "The lines, replacing an existing file: .dxf, .geojson or .csv in the scan's coordinates, or .svg, a "
              "drawing",
              ".dxf .svg .geojson .csv");
    addPlanes(app, options);
    addLengths(app, options);
    app.add_flag("--flat", options.flat,
                 "Write drawing coordinates (x to the right, y up, z = 0) instead of the scan's");
    addValue(app, "--up", "X,Y,Z", "Up in the scan's coordinates (default: the scan's up, else +Z)",
             [&](const std::string& text) { options.up = parseTriple(text); });
    addDeviceAndReport(app, options);
    addCommonOptions(app, POINTRT_VERSION, kWrongInput, kSectionExamples, kSectionNotes);
}

void checkOptions(const SectionOptions& options) {
    if (options.heights.empty() && options.planes.empty())
        throw Error(ExitCode::kBadUsage, "--height or --plane is required");
    checkTextOutput(options, {".dxf", ".svg", ".geojson", ".csv"});
    checkCommonOptions(options, {}, "section");
}

SectionRules rulesOf(const SectionOptions& options) {
    const double step = options.step ? *options.step : medianRadius(options.scene);
    return {step, options.gap.value_or(kDefaultGap * step), options.tolerance.value_or(kDefaultTolerance * step),
            options.shortest};
}

std::vector<DrawnSection> planesOf(const SectionOptions& options) {
    const Position up = upOfScene(options.up, options.scene);
    std::vector<DrawnSection> sections;
    for (const double height : options.heights)
        sections.push_back({"height " + plainText(height), levelPlane(height, up), {}});
    for (const std::string& text : options.planes) sections.push_back({text, sectionPlane(text, up), {}});
    return sections;
}

std::string fileText(const SectionOptions& options, const SectionDrawing& drawing) {
    if (options.output.ends_with(".svg")) return sectionSvg(drawing);
    if (options.output.ends_with(".csv")) return sectionCsv(drawing);
    return options.output.ends_with(".dxf") ? sectionDxf(drawing) : sectionGeoJson(drawing);
}

void drawSections(const SectionOptions& options, LineRun& run) {
    const SceneUnits units = sceneUnits(options.scene);
    const SectionRules rules = rulesOf(options);
    SectionDrawing drawing{planesOf(options), units.unit, units.decimals, units.epsg};
    const TraceScene scene = timed(run.open_s, [&] { return openScene(options, run.device); });
    timed(run.cast_s, [&] {
        for (DrawnSection& section : drawing.sections) section.lines = sectionLines(scene, section.plane, rules);
    });
    for (const DrawnSection& section : drawing.sections) {
        run.lines += section.lines.size();
        if (section.lines.empty()) printNote(options, "section: " + section.name + " cuts no surface");
    }
    timed(run.write_s, [&] {
        writeReport(options.output, fileText(options, options.flat ? flattened(std::move(drawing)) : drawing));
    });
}

} // namespace

int sectionCommand(int argc, const char* const* argv) {
    SectionOptions options;
    CommandLine app(kSectionAbout, kSectionName);
    addOptions(app, options);
    if (const auto done =
            parseCommandLine(app, argc, argv, {{".dxf", "-o"}, {".geojson", "-o"}, {".svg", "-o"}, {".csv", "-o"}}))
        return *done;
    checkOptions(options);
    LineRun run;
    withToolErrors([&] { timed(run.total_s, [&] { drawSections(options, run); }); });
    reportRun(options, run);
    return 0;
}

CommandText sectionText() {
    SectionOptions options;
    CommandLine app(kSectionAbout, kSectionName);
    addOptions(app, options);
    return describe(app);
}

} // namespace pointrt

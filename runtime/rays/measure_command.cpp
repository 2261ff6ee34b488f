// SPDX-License-Identifier: Apache-2.0
#include "runtime/rays/measure_command.h"

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "format/base/error.h"
#include "format/base/report_file.h"
#include "format/cli/command_line.h"
#include "format/os/descriptor.h"
#include "format/os/terminal.h"
#include "runtime/rays/given_positions.h"
#include "runtime/rays/measure_kinds.h"
#include "runtime/rays/open_scene.h"
#include "runtime/rays/run_report.h"
#include "runtime/rays/study_options.h"
#include "runtime/rays/text_output.h"
#include "runtime/util/parse.h"
#include "runtime/util/vec_array.h"

namespace pointrt {
namespace {

constexpr const char* kMeasureName = "pointrt-rays measure";
constexpr const char* kMeasureAbout =
    "Measures distances, angles, areas, volumes, circles and spheres at points of a scan.";
constexpr const char* kMeasureExamples =
    "  pointrt-rays measure site.pro --kind distance --points \"2600010,1200020,480 2600013,1200024,492\"\n"
    "  pointrt-rays measure roof.pro --kind area --points corners.csv --snap -o roof.dxf\n"
    "  pointrt-rays measure heap.pro --kind volume --points rim.csv --json\n"
    "  pointrt-rays measure pit.pro --kind volume --points rim.csv --base 431.5 --cell 0.05\n"
    "  pointrt-rays measure hall.pro --kind circle --points column.csv\n";
constexpr const char* kMeasureNotes =
    "distance and height take 2 points, angle 3 (at the second), polyline 2 or more, area, volume and circle 3 or\n"
    "more, sphere 4 or more. A volume lies between the surface seen from above and a base: the plane fitted to the\n"
    "rim, or a height; cut is above the base, fill below. See docs/RAYS.md.";

struct MeasureOptions : CommonOptions {
    MeasureKind kind = MeasureKind::kDistance;
    std::string points; ///< a list or a file
    bool snap = false, json = false;
    std::optional<std::array<double, 3>> up;
    std::optional<double> base_height;
    double cell = 0;
    bool has_volume_options = false;
};

void addVolumeOptions(CommandLine& app, MeasureOptions& options) {
    constexpr double kFarthest = 1e30; // the limit of coordinates in .pro files
    addValue(app, "--base", "rim|HEIGHT",
             "For volumes: the base, either rim (a plane fitted to the rim) or a height (default rim)",
             [&](const std::string& text) {
                 options.has_volume_options = true;
                 options.base_height.reset();
                 if (text != "rim") options.base_height = parseReal(text, -kFarthest, kFarthest);
             });
    addValue(app, "--cell", "SIZE",
             "For volumes: cell size of the raster of rays (default: a thousandth of the rim's longer side)",
             [&](const std::string& text) {
                 options.has_volume_options = true;
                 options.cell = parseRealAbove(text, 0, kFarthest);
             });
}

void addOptions(CommandLine& app, MeasureOptions& options) {
    addScene(app, options);
    addOutput(app, options,
              "Also write the result, replacing an existing file: .geojson or .dxf with its geometry, .csv or .json", //
              ".geojson .dxf .csv .json", false);
    addValue(
        app, "--kind", joinedNames(kMeasureKindNames, "|"), "What to measure",
        [&](const std::string& text) { options.kind = parseName(kMeasureKindNames, text); }, true);
    app.add_option(
           "--points", options.points,
           "The points, in the scan's coordinates: \"x,y,z x,y,z ...\", or a file with x y z as text or .npy; - "
           "is standard input")
        ->required()
        ->type_name("POINTS|FILE");
    completes(app, "--points", ".csv .txt .npy");
    app.add_flag(
        "--snap", options.snap,
        "First move each point to the nearest surface, or for a volume vertically to the surface seen from above");
    addVolumeOptions(app, options);
    addValue(app, "--up", "X,Y,Z", "Up in the scan's coordinates (default: the scan's up, else +Z)",
             [&](const std::string& text) { options.up = parseTriple(text); });
    app.add_flag("--json", options.json, "Print JSON");
    addDeviceAndReport(app, options);
    addCommonOptions(app, POINTRT_VERSION, kWrongInput, kMeasureExamples, kMeasureNotes);
}

void checkOptions(const MeasureOptions& options) {
    if (options.points == "-" && isTerminal(kStandardInput))
        throw Error(ExitCode::kBadUsage, "--points -: standard input is a terminal");
    if (options.has_volume_options && options.kind != MeasureKind::kVolume)
        throw Error(ExitCode::kBadUsage, "--base and --cell need --kind volume");
    checkTextOutput(options, {".geojson", ".dxf", ".csv", ".json"});
    checkCommonOptions(options, {options.points}, "results");
}

/// Moves points to the surface. Returns the largest distance that one moved.
double snapPoints(const TraceScene& scene, MeasureKind kind, const Position& up, std::vector<Position>& points) {
    const std::vector<Position> snapped =
        kind == MeasureKind::kVolume ? dropToSurface(scene, points, up) : snapToSurface(scene, points);
    double most = 0;
    for (std::size_t i = 0; i < points.size(); ++i) {
        const double moved = length(vectorOf(snapped[i]) - vectorOf(points[i]));
        if (!std::isfinite(moved))
            throw Error(ExitCode::kBadInput, "--points: point " + std::to_string(i + 1) + " has no surface to snap to");
        most = std::max(most, moved);
    }
    points = snapped;
    return most;
}

/// Measurements between given points need no device, but others do.
bool needsScene(const MeasureOptions& options) { return options.snap || options.kind == MeasureKind::kVolume; }

struct MeasureRun {
    std::string device;
    std::uint64_t rays = 0;
    double open_s = 0, cast_s = 0, total_s = 0;
};

Measured measureOnScene(const MeasureOptions& options, std::vector<Position> points, const Position& up,
                        MeasureRun& run) {
    const TraceScene scene = timed(run.open_s, [&] { return openScene(options, run.device); });
    return timed(run.cast_s, [&] {
        std::optional<double> moved;
        if (options.snap) moved = snapPoints(scene, options.kind, up, points);
        Measured measured;
        if (options.kind == MeasureKind::kVolume) {
            const Volume volume = measureVolume(scene, points, {up, options.base_height, options.cell});
            run.rays = volume.rays;
            measured = measuredVolume(volume, points);
        } else {
            measured = measurePoints(options.kind, points, up);
        }
        if (moved) measured.numbers.push_back({"snapped_by", *moved});
        return measured;
    });
}

std::string jsonOf(const MeasureOptions& options, const Measured& measured, const SceneUnits& units) {
    nlohmann::ordered_json json{{"kind", nameOf(kMeasureKindNames, options.kind)}, {"points", measured.points}};
    addResults(measured.numbers, units, json);
    return json.dump(2) + "\n";
}

std::string fileText(const MeasureOptions& options, const Measured& measured, const SceneUnits& units) {
    if (options.output.ends_with(".geojson")) return measuredGeoJson(measured, units);
    if (options.output.ends_with(".dxf")) return measuredDxf(measured, options.kind, units);
    if (options.output.ends_with(".csv")) return resultCsv(measured.numbers, units);
    return jsonOf(options, measured, units);
}

/// Warns if rays found no surface in a part of a rim.
void warnOfHoles(const MeasureOptions& options, const Measured& measured) {
    constexpr double kAllCovered = 1 - 1e-4; // as printed
    for (const ResultNumber& number : measured.numbers)
        if (number.name == "covered" && number.value < kAllCovered)
            printNote(options, "measure: part of the rim's area has no surface and does not count towards the volume "
                               "(see the result 'covered')");
}

void measure(const MeasureOptions& options, MeasureRun& run) {
    const std::vector<Position> points = givenPositions(options.points, "--points", false).positions;
    const SceneUnits units = sceneUnits(options.scene);
    const Position up = upOfScene(options.up, options.scene);
    const Measured measured =
        needsScene(options) ? measureOnScene(options, points, up, run) : measurePoints(options.kind, points, up);
    if (!options.output.empty()) writeReport(options.output, fileText(options, measured, units));
    writeReport("-", options.json ? jsonOf(options, measured, units) : resultText(measured.numbers, units));
    warnOfHoles(options, measured);
}

} // namespace

int measureCommand(int argc, const char* const* argv) {
    MeasureOptions options;
    CommandLine app(kMeasureAbout, kMeasureName);
    addOptions(app, options);
    if (const auto done = parseCommandLine(app, argc, argv, {{".geojson", "-o"}, {".dxf", "-o"}, {".csv", "--points"}}))
        return *done;
    checkOptions(options);
    MeasureRun run;
    withToolErrors([&] { timed(run.total_s, [&] { measure(options, run); }); });
    if (options.verbose && !run.device.empty()) printNote(options, std::to_string(run.rays) + " rays on " + run.device);
    if (!options.stats.empty())
        writeReport(options.stats, reportText(run.device, {{"rays", run.rays}},
                                              {{"open", run.open_s}, {"cast", run.cast_s}, {"total", run.total_s}}));
    return 0;
}

CommandText measureText() {
    MeasureOptions options;
    CommandLine app(kMeasureAbout, kMeasureName);
    addOptions(app, options);
    return describe(app);
}

} // namespace pointrt

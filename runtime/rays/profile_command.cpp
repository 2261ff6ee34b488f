// SPDX-License-Identifier: Apache-2.0
#include "runtime/rays/profile_command.h"

#include <algorithm>
#include <cmath>

#include "format/base/error.h"
#include "format/base/report_file.h"
#include "format/cli/command_line.h"
#include "format/os/descriptor.h"
#include "format/os/terminal.h"
#include "runtime/measure/profile_files.h"
#include "runtime/rays/given_positions.h"
#include "runtime/rays/open_scene.h"
#include "runtime/rays/run_report.h"
#include "runtime/rays/scene_units.h"
#include "runtime/rays/study_options.h"
#include "runtime/rays/text_output.h"
#include "runtime/util/names.h"
#include "runtime/util/parse.h"

namespace pointrt {
namespace {

constexpr const char* kProfileName = "pointrt-rays profile";
constexpr const char* kProfileAbout = "Draws the surface of a scan along a line.";
constexpr const char* kProfileExamples =
    "  pointrt-rays profile road.pro --line \"2600010,1200020 2600110,1200025\" --step 0.1 -o road.svg\n"
    "  pointrt-rays profile dam.pro --line axis.csv --width 0.5 -o dam.dxf\n"
    "  pointrt-rays profile hall.pro --line \"0,5 40,5\" --from below --start 1.5 -o ceiling.csv\n"
    "  pointrt-rays profile forest.pro --line axis.csv --all -o layers.csv\n";
constexpr const char* kProfileNotes =
    "Vertical rays at stations along the line find the first surface, or with --all every surface. Columns of .csv:\n"
    "station (horizontal distance along the line), x, y, z, height (along up), layer with --all, low and high with\n"
    "--width; z and height are empty where there is no surface. See docs/RAYS.md.";
constexpr std::array kProfileSideNames = {Name{"above", ProfileSide::kAbove}, Name{"below", ProfileSide::kBelow}};

struct ProfileOptions : CommonOptions {
    std::string line; ///< a list or a file
    ProfileRules rules;
    std::optional<std::array<double, 3>> up;
    std::optional<double> apart;
};

void addOptions(CommandLine& app, ProfileOptions& options) {
    constexpr double kFarthest = 1e30; // the limit of coordinates in .pro files
    addScene(app, options);
    addOutput(app, options, "The profile, replacing an existing file: .csv, .svg, or .dxf in the scan's coordinates",
              ".csv .svg .dxf");
    app.add_option("--line", options.line,
                   "Corners of the line: \"x,y x,y ...\" or \"x,y,z x,y,z ...\", or a file with x y [z] as text or "
                   ".npy; - is standard input. Heights are ignored")
        ->required()
        ->type_name("POINTS|FILE");
    completes(app, "--line", ".csv .txt .npy");
    addValue(app, "--step", "LENGTH", "Distance between stations along the line (default: a thousandth of the line)",
             [&](const std::string& text) { options.rules.step = parseRealAbove(text, 0, kFarthest); });
    addValue(app, "--width", "LENGTH",
             "Width of a band along the line: a station's height is the median across the band, and the lowest and "
             "highest are written too (default: one ray per station)",
             [&](const std::string& text) { options.rules.width = parseRealAbove(text, 0, kFarthest); });
    addValue(app, "--from", joinedNames(kProfileSideNames, "|"), "Side where rays start (default above)",
             [&](const std::string& text) { options.rules.from = parseName(kProfileSideNames, text); });
    addValue(app, "--start", "HEIGHT", "Height at which rays start, e.g. inside a room (default: outside the scan)",
             [&](const std::string& text) { options.rules.start_height = parseReal(text, -kFarthest, kFarthest); });
    app.add_flag("--all", options.rules.all, "Write every surface that a ray passes through, not only the first");
    addValue(app, "--apart", "LENGTH",
             "With --all: count surfaces closer together than this as one (default: the scan's point spacing, "
             "twice the median radius)",
             [&](const std::string& text) { options.apart = parseReal(text, 0, kFarthest); });
    addValue(app, "--up", "X,Y,Z", "Up in the scan's coordinates (default: the scan's up, else +Z)",
             [&](const std::string& text) { options.up = parseTriple(text); });
    addDeviceAndReport(app, options);
    addCommonOptions(app, POINTRT_VERSION, kWrongInput, kProfileExamples, kProfileNotes);
}

void checkOptions(const ProfileOptions& options) {
    const auto usage = [](const char* text) { throw Error(ExitCode::kBadUsage, text); };
    if (options.line == "-" && isTerminal(kStandardInput)) usage("--line -: standard input is a terminal");
    if (options.rules.all && options.rules.width > 0) usage("--all and --width cannot be combined");
    if (options.apart && !options.rules.all) usage("--apart needs --all");
    checkTextOutput(options, {".csv", ".svg", ".dxf"});
    checkCommonOptions(options, {options.line}, "profile");
}

std::vector<Position> lineOf(const ProfileOptions& options, const Position& up) {
    const GivenPositions given = givenPositions(options.line, "--line", true);
    constexpr double kUpright = 1 - 1e-9;
    if (!given.has_z && std::abs(up[2]) < kUpright)
        throw Error(ExitCode::kBadUsage, "--line: x,y suffices only if z is up; give x,y,z");
    return given.positions;
}

ProfileRules rulesOf(const ProfileOptions& options, const Position& up) {
    ProfileRules rules = options.rules;
    rules.up = up;
    if (rules.all) rules.apart = options.apart ? *options.apart : 2 * medianRadius(options.scene);
    return rules;
}

struct ProfileRun {
    std::string device;
    std::uint64_t points = 0, hits = 0;
    double open_s = 0, cast_s = 0, write_s = 0, total_s = 0;
};

std::string fileText(const ProfileOptions& options, const ProfileDrawing& drawing) {
    if (options.output.ends_with(".svg")) return profileSvg(drawing);
    return options.output.ends_with(".dxf") ? profileDxf(drawing) : profileCsv(drawing);
}

void profile(const ProfileOptions& options, ProfileRun& run) {
    const Position up = upOfScene(options.up, options.scene);
    const std::vector<Position> line = lineOf(options, up);
    const ProfileRules rules = rulesOf(options, up);
    const SceneUnits units = sceneUnits(options.scene);
    const TraceScene scene = timed(run.open_s, [&] { return openScene(options, run.device); });
    const ProfileDrawing drawing{timed(run.cast_s, [&] { return surfaceProfile(scene, line, rules); }), units.unit,
                                 units.decimals, rules.width > 0};
    timed(run.write_s, [&] { writeReport(options.output, fileText(options, drawing)); });
    run.points = drawing.points.size();
    run.hits = static_cast<std::uint64_t>(std::ranges::count_if(drawing.points, &ProfilePoint::hit));
    if (run.hits == 0) printNote(options, "profile: the rays hit no surface");
}

} // namespace

int profileCommand(int argc, const char* const* argv) {
    ProfileOptions options;
    CommandLine app(kProfileAbout, kProfileName);
    addOptions(app, options);
    if (const auto done = parseCommandLine(app, argc, argv, {{".svg", "-o"}, {".dxf", "-o"}, {".csv", "--line"}}))
        return *done;
    checkOptions(options);
    ProfileRun run;
    withToolErrors([&] { timed(run.total_s, [&] { profile(options, run); }); });
    if (options.verbose)
        printNote(options,
                  std::to_string(run.points) + " points, " + std::to_string(run.hits) + " hits on " + run.device);
    if (!options.stats.empty())
        writeReport(
            options.stats,
            reportText(run.device, {{"rays", run.points}, {"hits", run.hits}},
                       {{"open", run.open_s}, {"cast", run.cast_s}, {"write", run.write_s}, {"total", run.total_s}}));
    return 0;
}

CommandText profileText() {
    ProfileOptions options;
    CommandLine app(kProfileAbout, kProfileName);
    addOptions(app, options);
    return describe(app);
}

} // namespace pointrt

// SPDX-License-Identifier: Apache-2.0
#include "runtime/rays/compare_command.h"

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "format/base/error.h"
#include "format/base/report_file.h"
#include "format/cli/command_line.h"
#include "pointrt/measure.hpp"
#include "runtime/rays/result_numbers.h"
#include "runtime/rays/run_report.h"
#include "runtime/rays/study_run.h"
#include "runtime/util/parse.h"

namespace pointrt {
namespace {

constexpr const char* kCompareName = "pointrt-rays compare";
constexpr const char* kCompareAbout = "Measures signed distances of a scan's points from the surface of another scan.";
constexpr const char* kCompareExamples = "  pointrt-rays compare before.pro after.pro --max 0.5 -o change.ply\n"
                                         "  pointrt-rays compare design.pro built.pro --tolerance 0.01 --json\n"
                                         "  pointrt-rays compare before.pro after.pro -o change.pro\n"
                                         "  pointrt-view change.pro --color-by distance --legend on\n";
constexpr const char* kCompareNotes =
    "Two rays start at each point of the second scan, forwards and backwards along its normal; the nearer hit on the "
    "first\n"
    "scan counts. The column distance is positive where the point lies in front of that surface, on the side to which\n"
    "the point's normal points, negative behind it, and NaN where there is no surface within --max. See docs/RAYS.md.";

/// Default of --max, in median radii of the reference: ten times the spacing of its points.
constexpr double kMostRadii = 20;

struct CompareOptions : StudyOptions {
    double most = 0; ///< 0: the default, kMostRadii radii
    std::optional<double> tolerance;
    bool json = false;
};

void addOptions(CommandLine& app, CompareOptions& options) {
    constexpr double kFarthest = 1e30; // the limit of coordinates in .pro files
    app.option_defaults()->multi_option_policy(CLI::MultiOptionPolicy::TakeLast);
    app.add_option("SCENE", options.scene,
                   "Two scans. First the reference: a .pro file, tile set (.proset) or scene file (.toml). Then the "
                   "scan to compare: one of these, or a .ply or text file of points with normals")
        ->required()
        ->type_name("")
        ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll);
    completes(app, "SCENE", ".pro .proset .toml .ply");
    addPointOutput(app, options, false);
    addValue(
        app, "--max", "DISTANCE",
        "Largest distance to measure, in the scan's unit (default: 20 times the median splat radius of the reference)",
        [&](const std::string& text) { options.most = parseRealAbove(text, 0, kFarthest); });
    addValue(app, "--tolerance", "DISTANCE", "Also print the share of points farther away than this (default: off)",
             [&](const std::string& text) { options.tolerance = parseReal(text, 0, kFarthest); });
    app.add_flag("--json", options.json, "Print the statistics as JSON");
    addDeviceAndReport(app, options);
    addCommonOptions(app, POINTRT_VERSION, kWrongInput, kCompareExamples, kCompareNotes);
}

/// Splits the two scans into the scene and the points.
void checkOptions(CompareOptions& options) {
    if (options.scene.size() != 2)
        throw Error(ExitCode::kBadUsage, "two scans are needed, the reference and the one to compare, not " +
                                             std::to_string(options.scene.size()));
    options.points = options.scene.back();
    options.scene.pop_back();
    if (options.stats == "-")
        throw Error(ExitCode::kBadUsage, "--stats -: the statistics are printed there; give a file");
    if (options.output == "-" && !options.quiet)
        throw Error(ExitCode::kBadUsage, "-o -: the statistics are printed there; add -q to write points only");
    checkStudyOptions(options);
}

std::vector<ResultNumber> statisticsOf(std::vector<double>& distances, const CompareOptions& options, double most) {
    std::size_t beyond = 0;
    for (const double distance : distances) beyond += options.tolerance && std::abs(distance) > *options.tolerance;
    const DistanceStatistics s = distanceStatistics(distances);
    const double all = static_cast<double>(s.count + s.missing), known = static_cast<double>(s.count);
    std::vector<ResultNumber> numbers{{"points", all, Quantity::kCount},
                                      {"measured", known, Quantity::kCount},
                                      {"missing", static_cast<double>(s.missing) / all, Quantity::kShare},
                                      {"max", most},
                                      {"mean", s.mean},
                                      {"standard_deviation", s.deviation},
                                      {"rms", s.rms},
                                      {"median", s.median},
                                      {"absolute_95_percent", s.percentile_95},
                                      {"lowest", s.low},
                                      {"highest", s.high}};
    if (options.tolerance)
        numbers.push_back({"beyond_tolerance", static_cast<double>(beyond) / known, Quantity::kShare});
    return numbers;
}

/// The distances as a float32 column. NaN stays NaN: no surface within reach.
std::vector<std::byte> columnOf(const std::vector<double>& distances) {
    std::vector<std::byte> values(distances.size() * sizeof(float));
    std::ranges::transform(distances, numbersIn<float>(values).begin(),
                           [](double distance) { return static_cast<float>(distance); });
    return values;
}

void compare(const CompareOptions& options) {
    const SceneUnits units = withToolErrors([&] { return sceneUnits(options.scene); });
    std::vector<double> all;
    double most = options.most;
    StudyWork work;
    work.results = {{"distance", PRO_TYPE_F32}};
    work.begin = [&](OpenStudy& study) {
        if (most == 0) most = kMostRadii * study.rules.radius;
        if (!(most > 0)) throw Error(ExitCode::kBadUsage, "--max is needed: the reference has no radii");
    };
    work.block = [&](const OpenStudy& study, const StudyPoints& points, std::size_t count,
                     std::vector<std::vector<std::byte>>& values, const ReportProgress&) {
        if (points.normals.empty())
            throw Error(ExitCode::kBadInput, options.points + ": has no normals; bake it with pointrt-bake first");
        std::vector<double> distances(count);
        const std::uint64_t rays = surfaceDistances(study.scene, points, most, distances);
        values[0] = columnOf(distances);
        all.insert(all.end(), distances.begin(), distances.end());
        return rays;
    };
    runStudy(options, work);
    const std::vector<ResultNumber> numbers = statisticsOf(all, options, most);
    if (options.output == "-") return;
    nlohmann::ordered_json json;
    addResults(numbers, units, json);
    writeReport("-", options.json ? json.dump(2) + "\n" : resultText(numbers, units));
}

} // namespace

int compareCommand(int argc, const char* const* argv) {
    CompareOptions options;
    CommandLine app(kCompareAbout, kCompareName);
    addOptions(app, options);
    if (const auto done = parseCommandLine(app, argc, argv, {{".las", "-o"}, {".laz", "-o"}, {".csv", "-o"}}))
        return *done;
    checkOptions(options);
    compare(options);
    return 0;
}

CommandText compareText() {
    CompareOptions options;
    CommandLine app(kCompareAbout, kCompareName);
    addOptions(app, options);
    return describe(app);
}

} // namespace pointrt

// SPDX-License-Identifier: Apache-2.0
#include "runtime/rays/cast_options.h"

#include <unistd.h>

#include "format/base/error.h"
#include "format/cli/command_line.h"

namespace pointrt {
namespace {

constexpr const char* kName = "pointrt-rays cast";
constexpr const char* kAbout = "Casts rays at scans: what each of them hits first, or whether it hits anything.";
constexpr const char* kExamples =
    "  pointrt-rays cast site.pro --rays rays.npy -o hits.npz\n"
    "  pointrt-rays cast site.pro --rays rays.csv -o points.ply --attributes intensity,classification\n"
    "  pointrt-rays cast a.pro b.pro --rays rays.npy --any --t-max 1000 -o hit.npy\n"
    "  pointrt-rays cast city.proset --rays rays.npy --memory 4G -o hits.npz\n"
    "  make_rays | pointrt-rays cast site.pro --rays - --any -o - | use_answers\n";
constexpr const char* kNotes =
    "RAYS are (N, 6): origin and direction in the scan's coordinates, float64 or float32 (.npy), or text, six\n"
    "numbers a line. Columns of hits: t_hit (lengths of the direction; inf for a miss), splat_ids, instance_ids\n"
    "(4294967295 for a miss), of sets tile_ids, normals, positions; docs/RAYS.md has more.";

void addOptions(CommandLine& app, CastOptions& options) {
    addSceneAndOutput(app, options,
                      "Hits, by the suffix: .npz, .npy (records), .csv, .ply (points that were hit); - is a stream, an "
                      "array for arrays and text for text; what is there is replaced",
                      ".npz .npy .csv .ply");
    app.add_option("--rays", options.rays, "Rays: .npy or text, - is standard input")->required()->type_name("FILE");
    completes(app, "--rays", ".npy .csv .txt");
    app.add_flag("--any", options.any, "Only whether anything is hit, which is sooner known: the column hit");
    app.add_option("--attributes", options.attributes, "Attributes of the scan at the hits, such as intensity,gps_time")
        ->type_name("NAMES")
        ->delimiter(',')
        ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll);
    app.add_option("--t-min", options.limits.t_min, "What is nearer does not count, in lengths of the direction (0)")
        ->type_name("T");
    app.add_option("--t-max", options.limits.t_max, "What is farther does not count (inf)")->type_name("T");
    addDeviceAndReport(app, options);
    addCommonOptions(app, POINTRT_VERSION, kWrongInput, kExamples, kNotes);
}

void checkOptions(const CastOptions& options) {
    const auto usage = [](const std::string& text) { throw Error(ExitCode::kBadUsage, text); };
    if (options.any && !options.attributes.empty()) usage("--any and --attributes exclude each other");
    if (options.rays == "-" && isatty(STDIN_FILENO) == 1) usage("--rays -: standard input is a terminal");
    checkCommonOptions(options, {options.rays}, "hits");
}

} // namespace

std::optional<int> parseCastOptions(int argc, const char* const* argv, CastOptions& options) {
    CommandLine app(kAbout, kName);
    addOptions(app, options);
    if (const auto done =
            parseCommandLine(app, argc, argv, {{".npz", "-o"}, {".npy", "--rays"}, {".csv", "--rays"}, {".ply", "-o"}}))
        return done;
    checkOptions(options);
    return {};
}

CommandText castText() {
    CastOptions options;
    CommandLine app(kAbout, kName);
    addOptions(app, options);
    return describe(app);
}

} // namespace pointrt

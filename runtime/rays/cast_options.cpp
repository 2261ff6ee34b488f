// SPDX-License-Identifier: Apache-2.0
#include "runtime/rays/cast_options.h"

#include "format/base/error.h"
#include "format/cli/command_line.h"
#include "format/os/descriptor.h"
#include "format/os/terminal.h"

namespace pointrt {
namespace {

constexpr const char* kCastName = "pointrt-rays cast";
constexpr const char* kCastAbout = "Casts rays at scans and writes their first hits, or whether they hit anything.";
constexpr const char* kCastExamples =
    "  pointrt-rays cast site.pro --rays rays.npy -o hits.npz\n"
    "  pointrt-rays cast site.pro --rays rays.csv -o points.ply --attributes intensity,classification\n"
    "  pointrt-rays cast a.pro b.pro --rays rays.npy --any --t-max 1000 -o hit.npy\n"
    "  pointrt-rays cast city.proset --rays rays.npy --memory 4G -o hits.npz\n"
    "  make_rays | pointrt-rays cast site.pro --rays - --any -o - | use_answers\n";
constexpr const char* kCastNotes =
    "A ray is an origin and a direction in the scan's coordinates. Rays are a NumPy array (N, 6) of float32 or "
    "float64,\n"
    "or text with six numbers per line. Columns of hits: t_hit (in lengths of the direction; inf for a miss), "
    "splat_ids and\n"
    "instance_ids (4294967295 for a miss), tile_ids (tile sets only), normals, positions. See docs/RAYS.md.";

void addOptions(CommandLine& app, CastOptions& options) {
    addScene(app, options);
    addOutput(app, options,
              "Hits, replacing an existing file: .npz, .npy (records), .csv or .ply (hit points); - is standard "
              "output, as a NumPy array or text like the rays",
              ".npz .npy .csv .ply");
    app.add_option("--rays", options.rays, "Rays: .npy or text; - is standard input")->required()->type_name("FILE");
    completes(app, "--rays", ".npy .csv .txt");
    app.add_flag("--any", options.any, "Test occlusion only, which is faster; writes the column hit");
    app.add_option("--attributes", options.attributes,
                   "Attributes of the scan to write for each hit, e.g. intensity,gps_time")
        ->type_name("NAMES")
        ->delimiter(',')
        ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll);
    app.add_option("--t-min", options.limits.t_min, "Ignore hits before T, in lengths of the direction (default 0)")
        ->type_name("T");
    app.add_option("--t-max", options.limits.t_max,
                   "Ignore hits at T and beyond, in lengths of the direction (default inf)")
        ->type_name("T");
    addDeviceAndReport(app, options);
    addCommonOptions(app, POINTRT_VERSION, kWrongInput, kCastExamples, kCastNotes);
}

void checkOptions(const CastOptions& options) {
    const auto usage = [](const std::string& text) { throw Error(ExitCode::kBadUsage, text); };
    if (options.any && !options.attributes.empty()) usage("--any and --attributes cannot be combined");
    if (options.rays == "-" && isTerminal(kStandardInput)) usage("--rays -: standard input is a terminal");
    checkCommonOptions(options, {options.rays}, "hits");
}

} // namespace

std::optional<int> parseCastOptions(int argc, const char* const* argv, CastOptions& options) {
    CommandLine app(kCastAbout, kCastName);
    addOptions(app, options);
    if (const auto done =
            parseCommandLine(app, argc, argv, {{".npz", "-o"}, {".npy", "--rays"}, {".csv", "--rays"}, {".ply", "-o"}}))
        return done;
    checkOptions(options);
    return {};
}

CommandText castText() {
    CastOptions options;
    CommandLine app(kCastAbout, kCastName);
    addOptions(app, options);
    return describe(app);
}

} // namespace pointrt

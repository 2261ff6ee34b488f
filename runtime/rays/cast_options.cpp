// SPDX-License-Identifier: Apache-2.0
#include "runtime/rays/cast_options.h"

#include <unistd.h>

#include "format/base/command_line.h"
#include "format/base/same_file.h"

namespace pointrt {
namespace {

constexpr const char* kExamples =
    "  pointrt-rays cast site.pro --rays rays.npy -o hits.npz\n"
    "  pointrt-rays cast site.pro --rays rays.csv -o points.ply --attributes intensity,classification\n"
    "  pointrt-rays cast a.pro b.pro --rays rays.npy --any --t-max 1000 -o hit.npy\n"
    "  make_rays | pointrt-rays cast site.pro --rays - --any -o - | use_answers\n";
constexpr const char* kNotes =
    "RAYS are (N, 6): origin and direction in the scan's coordinates, float64 or float32 (.npy), or text, six\n"
    "numbers a line. Columns of hits: t_hit (lengths of the direction; inf for a miss), splat_ids, instance_ids\n"
    "(4294967295 for a miss), normals, positions; docs/RAYS.md has more.\n"
    "Exit codes: 0 done, 1 an input is wrong, 2 wrong usage, 3 this machine cannot, 4 cannot write.";

void addOptions(CLI::App& app, CastOptions& options) {
    app.option_defaults()->multi_option_policy(CLI::MultiOptionPolicy::TakeLast);
    app.add_option("SCENE", options.scene, "One or more .pro files: instance_ids count them from 0")
        ->required()
        ->type_name("")
        ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll);
    app.add_option("--rays", options.rays, "Rays: .npy or text, - is standard input")->required()->type_name("FILE");
    app.add_option("-o,--output", options.output,
                   "Hits, by the suffix: .npz, .npy (records), .csv, .ply (points that were hit); - is a stream, an "
                   "array for arrays and text for text; what is there is replaced")
        ->required()
        ->type_name("FILE");
    app.add_flag("--any", options.any, "Only whether anything is hit, which is sooner known: the column hit");
    app.add_option("--attributes", options.attributes, "Attributes of the scan at the hits, such as intensity,gps_time")
        ->type_name("NAMES")
        ->delimiter(',')
        ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll);
    app.add_option("--t-min", options.limits.t_min, "What is nearer does not count, in lengths of the direction (0)")
        ->type_name("T");
    app.add_option("--t-max", options.limits.t_max, "What is farther does not count (inf)")->type_name("T");
    app.add_option("--device", options.device,
                   "Vulkan device, by index or a part of its name (the best one); "
                   "pointrt-view --device list lists them")
        ->type_name("DEVICE");
    app.add_option("--stats", options.stats, "Write a report as JSON; - is standard output")->type_name("FILE");
    app.add_flag("-q,--quiet", options.quiet, "No progress, only errors");
    app.add_flag("-v,--verbose", options.verbose, "Say what was done, and how fast");
    addCommonOptions(app, POINTRT_VERSION, kExamples, kNotes);
}

void checkOptions(const CastOptions& options) {
    const auto usage = [](const std::string& text) { throw Error(ExitCode::kBadUsage, text); };
    if (options.quiet && options.verbose) usage("-q and -v exclude each other");
    if (options.any && !options.attributes.empty()) usage("--any and --attributes exclude each other");
    if (options.output == "-" && options.stats == "-")
        usage("-o - and --stats - exclude each other: both write to standard output");
    if (options.output == "-" && isatty(STDOUT_FILENO) == 1)
        usage("-o -: standard output is a terminal; let a file or a pipe take the hits");
    if (options.rays == "-" && isatty(STDIN_FILENO) == 1) usage("--rays -: standard input is a terminal");
    std::vector<std::string> inputs = options.scene;
    inputs.push_back(options.rays);
    for (const std::string& input : inputs)
        for (const std::string& output : {options.output, options.stats})
            if (input != "-" && output != "-" && !output.empty() && isSameFile(input, output))
                usage(output + ": is an input");
    if (!options.stats.empty() && options.stats != "-" && isSameFile(options.stats, options.output))
        usage(options.stats + ": is the output");
}

} // namespace

std::optional<int> parseCastOptions(int argc, const char* const* argv, CastOptions& options) {
    CLI::App app("Casts rays at scans: what each of them hits first, or whether it hits anything.",
                 "pointrt-rays cast");
    addOptions(app, options);
    if (const auto done =
            parseCommandLine(app, argc, argv, {{".npz", "-o"}, {".npy", "--rays"}, {".csv", "--rays"}, {".ply", "-o"}}))
        return done;
    checkOptions(options);
    return {};
}

std::string raysHelp() {
    return "Asks scans what rays meet.\n"
           "Usage: pointrt-rays COMMAND ...\n\n"
           "Commands:\n"
           "  cast    first hits, or occlusion, of any rays\n\n"
           "pointrt-rays COMMAND --help tells more of each. --version prints the version.\n";
}

} // namespace pointrt

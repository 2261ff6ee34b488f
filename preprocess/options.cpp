// SPDX-License-Identifier: GPL-3.0-or-later
#include "preprocess/options.h"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cmath>
#include <map>

#include "pointrt/tool.hpp"

namespace pointrt {

namespace {

const std::map<std::string, NormalSource> kNormalSources{
    {"auto", NormalSource::kAuto}, {"keep", NormalSource::kKeep}, {"estimate", NormalSource::kEstimate}};
const std::map<std::string, OrientMode> kOrientModes{{"auto", OrientMode::kAuto},
                                                     {"sensor", OrientMode::kSensor},
                                                     {"mst", OrientMode::kMst},
                                                     {"none", OrientMode::kNone}};
const std::map<std::string, bool> kSwitch{{"on", true}, {"off", false}};
const std::map<std::string, bool> kOutlierModes{{"remove", true}, {"keep", false}};

template <typename Value>
CLI::Option* addChoice(CLI::App& app, const std::string& name, Value& value,
                       const std::map<std::string, Value>& choices, const std::string& help) {
    return app
        .add_option_function<std::string>(
            name,
            [&value, &choices, name](const std::string& text) {
                const auto choice = choices.find(text);
                if (choice != choices.end()) {
                    value = choice->second;
                    return;
                }
                std::string known;
                for (const auto& [key, unused] : choices) known += (known.empty() ? "" : ", ") + key;
                throw CLI::ValidationError(name, "'" + text + "' is none of " + known);
            },
            help)
        ->type_name("");
}

void addInputOptions(CLI::App& app, BakeOptions& options) {
    app.add_option("input", options.inputs, "scan files, merged into one cloud; - reads standard input")->required();
    app.add_option("-o,--output", options.output, "the .pro to write")->required()->type_name("FILE");
    app.add_flag("-f,--force", options.force, "overwrite the output");
    app.add_option("--input-format", options.read.format, "ply, pcd, xyz, obj, off, drc or conf (default: by content)")
        ->check(CLI::IsMember({"ply", "pcd", "xyz", "obj", "off", "drc", "conf"}))
        ->type_name("NAME");
    app.add_option("--sample", options.read.sample_count,
                   "points to spread over a mesh's faces (default: its vertices)")
        ->check(CLI::Range(std::uint64_t{1}, std::uint64_t{2000000000}))
        ->type_name("N");
    app.add_option("--seed", options.read.seed, "of sampling and probe rays (default 0)")->type_name("N");
}

void addSurfaceOptions(CLI::App& app, BakeOptions& options) {
    auto& surface = options.surface;
    addChoice(app, "--normals", surface.normals, kNormalSources,
              "keep|estimate|auto: auto estimates missing ones (auto)");
    app.add_option("--neighbors", surface.neighbors, "of a normal estimate, 3 to 255 (default 16)")
        ->check(CLI::Range(3, 255))
        ->type_name("K");
    addChoice(app, "--orient", surface.orient, kOrientModes,
              "auto|sensor|mst|none: auto takes sensors where known, else a minimum spanning tree (auto)");
    app.add_option("--radius-scale", surface.radius_scale, "multiplies the radii, 0.01 to 100 (default 1)")
        ->check(CLI::Range(0.01, 100.0))
        ->type_name("S");
    addChoice(app, "--outliers", surface.remove_outliers, kOutlierModes,
              "remove|keep points far off any surface (remove)");
    app.add_option("--reflectivity", options.reflectivity, "of the material, 0 matte to 1 mirror (default 0)")
        ->check(CLI::Range(0.0, 1.0))
        ->type_name("R");
}

void addOctreeOptions(CLI::App& app, BakeOptions& options) {
    app.add_option("--max-leaf-splats", options.octree.max_leaf_splats,
                   "members before a leaf splits, 1 to 65535 (default 8)")
        ->check(CLI::Range(1u, PRO_LEAF_LIST_MAX))
        ->type_name("N");
    app.add_option("--max-depth", options.octree.max_depth, "levels below the root, 0 to 21 (default 21)")
        ->check(CLI::Range(0u, PRO_MAX_DEPTH))
        ->type_name("N");
    addChoice(app, "--prune", options.prune, kSwitch,
              "on|off: drop references that probe rays show to be needless (on)");
    app.add_option("--probe-rays", options.probes.probe_rays, "probes a leaf, 1 to 65536 (default 64)")
        ->check(CLI::Range(1u, 65536u))
        ->type_name("N");
}

void addReportOptions(CLI::App& app, BakeOptions& options) {
    app.add_option("-j,--threads", options.threads, "threads, 0 uses all cores (default 0)")
        ->check(CLI::Range(0, 4096))
        ->type_name("N");
    app.add_option("--stats", options.stats_path, "write figures as JSON; - is standard output")->type_name("FILE");
    app.add_flag_callback(
        "-q,--quiet", [&] { options.verbosity = Verbosity::kQuiet; }, "no progress");
    app.add_flag_callback(
        "-v,--verbose", [&] { options.verbosity = Verbosity::kDetailed; }, "more detail");
}

void checkOptions(BakeOptions& options) {
    const auto usage = [](const std::string& text) { throw Error(ExitCode::kBadUsage, text); };
    const std::string suffix = ".pro";
    const bool named = options.output.size() > suffix.size() && options.output.ends_with(suffix);
    if (!named) usage(options.output + ": the output's name must end in .pro");
    const bool from_stdin = std::find(options.inputs.begin(), options.inputs.end(), "-") != options.inputs.end();
    if (from_stdin && options.read.format.empty()) usage("-: standard input needs --input-format");
    if (std::count(options.inputs.begin(), options.inputs.end(), "-") > 1)
        usage("-: standard input can be read only once");
    if (!std::isfinite(options.surface.radius_scale)) usage("--radius-scale: must be a number");
    if (!std::isfinite(options.reflectivity)) usage("--reflectivity: must be a number");
    options.probes.seed = options.read.seed;
}

} // namespace

bool parseOptions(int argc, char** argv, BakeOptions& options) {
    CLI::App app{"Bakes point scans into a .pro file that pointrt-view ray traces.\n"
                 "Reads PLY, PCD, XYZ/PTS/ASC/TXT/CSV, OBJ, OFF, Draco and Stanford .conf sets.",
                 "pointrt-bake"};
    app.set_version_flag("--version", "pointrt-bake " POINTRT_VERSION);
    addInputOptions(app, options);
    addSurfaceOptions(app, options);
    addOctreeOptions(app, options);
    addReportOptions(app, options);
    try {
        app.parse(argc, argv);
    } catch (const CLI::Success& request) { // help and version
        app.exit(request);
        return false;
    } catch (const CLI::ParseError& error) {
        throw Error(ExitCode::kBadUsage, std::string(error.what()) + " (see --help)");
    }
    checkOptions(options);
    return true;
}

} // namespace pointrt

// SPDX-License-Identifier: GPL-3.0-or-later
#include "preprocess/app/options.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <map>
#include <thread>

#include "format/base/error.h"
#include "format/cli/command_line.h"
#include "preprocess/app/filter_options.h"
#include "preprocess/app/set_options.h"
#include "preprocess/input/folders.h"
#include "preprocess/input/formats.h"

namespace pointrt {

namespace {

const std::map<std::string, NormalSource> kNormalSources{
    {"auto", NormalSource::kAuto}, {"keep", NormalSource::kKeep}, {"estimate", NormalSource::kEstimate}};
const std::map<std::string, OrientMode> kOrientModes{{"auto", OrientMode::kAuto},
                                                     {"sensor", OrientMode::kSensor},
                                                     {"mst", OrientMode::kMst},
                                                     {"up", OrientMode::kUp},
                                                     {"none", OrientMode::kNone}};
const std::map<std::string, bool> kSwitch{{"on", true}, {"off", false}};
const std::map<std::string, ProgressStyle> kProgressStyles{{"auto", ProgressStyle::kAuto},
                                                           {"lines", ProgressStyle::kLines}};
const std::map<std::string, bool> kOutlierModes{{"remove", true}, {"keep", false}};

template <typename Value>
std::string nameIn(const std::map<std::string, Value>& choices, Value value) {
    return std::find_if(choices.begin(), choices.end(), [&](const auto& choice) { return choice.second == value; })
        ->first;
}

template <typename Value>
std::string joined(const std::map<std::string, Value>& choices) {
    std::string names;
    for (const auto& [name, unused] : choices) names += (names.empty() ? "" : "|") + name;
    return names;
}

template <typename Value>
CLI::Option* addChoice(CommandLine& app, const std::string& name, Value& value,
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
                throw CLI::ValidationError(name, "'" + text + "' is none of " + joined(choices));
            },
            help)
        ->type_name(joined(choices));
}

constexpr const char* kExamples =
    "  pointrt-bake scan.ply -o scan.pro\n"
    "  pointrt-bake a.ply b.pcd -o all.pro               two scans that share coordinates\n"
    "  pointrt-bake tiles/ --classes 2,6 -o city.pro     ground and buildings of a folder of tiles\n"
    "  pointrt-bake mesh.obj --sample 1000000 -o mesh.pro\n"
    "  zcat scan.xyz.gz | pointrt-bake - -f -o scan.pro\n";

/// A range check that leaves saying the range to the option's own help text.
template <typename Value>
CLI::Validator range(Value least, Value most) {
    return CLI::Range(least, most).description("");
}

/// CLI11 takes -1 for 2^64 - 1.
CLI::Validator notNegative() {
    return {[](const std::string& text) { return text.starts_with('-') ? text + " is below 0" : std::string(); }, ""};
}

void addInputFormat(CommandLine& app, std::string& format) {
    std::vector<std::string> names;
    for (const InputFormat& each : inputFormats()) names.emplace_back(each.name);
    std::string list = names.front();
    for (std::size_t i = 1; i < names.size(); ++i) list += (i + 1 < names.size() ? ", " : " or ") + names[i];
    app.add_option("--input-format", format, "Format: " + list + " (default: by content)")
        ->check(CLI::IsMember(names).description(""))
        ->type_name("NAME");
    completes(app, "--input-format", joinedWords(names, " "));
}

/// Those of all formats, as they are and gzipped.
std::string scanSuffixes() {
    std::string list;
    for (const InputFormat& each : inputFormats())
        forSuffixes(each, [&](std::string_view suffix) {
            list += "." + std::string(suffix) + " ." + std::string(suffix) + ".gz ";
        });
    return list;
}

void addInputOptions(CommandLine& app, BakeOptions& options) {
    app.option_defaults()->group("Scans in, scene out");
    app.add_option("SCAN", options.inputs,
                   "Scan files and folders of them, merged into one cloud; - reads standard input")
        ->required()
        ->type_name("")
        ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll);
    completes(app, "SCAN", scanSuffixes());
    app.add_option("-o,--output", options.output,
                   "The .pro to write, or a folder NAME.proset of many of them for scans of any size; a bake takes "
                   "long, so one that is there is kept without -f")
        ->type_name("FILE")
        ->option_text("FILE REQUIRED");
    completes(app, "--output", ".pro .proset");
    app.add_flag("-f,--force", options.force, "Overwrite the output");
    app.add_flag_callback(
        "--compact", [&] { options.index = false; },
        "Leave the tracing index out: a file a quarter the size, which pointrt-view opens more slowly");
    addInputFormat(app, options.read.format);
    app.add_option_function<std::uint64_t>(
           "--sample", [&](std::uint64_t count) { options.read.sample_count = count; },
           "Points to spread over a mesh's faces, 0 to 2000000000, 0 takes its vertices (default: as many as it needs "
           "where its vertices are too few)")
        ->check(range(std::uint64_t{0}, std::uint64_t{2000000000}))
        ->check(notNegative())
        ->type_name("N");
    app.add_option("--seed", options.read.seed, "Of sampling and probe rays (default 0, 0 to 2^64 - 1)")
        ->check(notNegative())
        ->type_name("N");
}

/// Calls take(words) with the option's text.
template <typename Take>
CLI::Option* addParsed(CommandLine& app, const std::string& name, const std::string& help, const Take& take) {
    return app.add_option_function<std::string>(name, take, help);
}

void addFilterOptions(CommandLine& app, BakeOptions& options) {
    app.option_defaults()->group("Which points, and where");
    auto& read = options.read;
    addParsed(app, "--bounds", "Only points inside, in the scan's coordinates", [&](const std::string& text) {
        read.filter.bounds = parseBounds(text);
    })->type_name("MINX,MINY,MINZ,MAXX,MAXY,MAXZ");
    CLI::Option* const classes =
        addParsed(app, "--classes", "Only points of these classes, as 2,6 or 3-5", [&](const std::string& text) {
            read.filter.keep_classes = parseClasses("--classes", text);
        })->type_name("LIST");
    addParsed(app, "--drop-classes", "No points of these classes",
              [&](const std::string& text) {
                  read.filter.keep_classes = parseClasses("--drop-classes", text);
                  read.filter.keep_classes.flip();
              })
        ->type_name("LIST")
        ->excludes(classes);
    app.add_option("--thin", read.filter.thin_spacing, "One point in each cube of this edge, the first of the input")
        ->check(range(std::numeric_limits<double>::min(), std::numeric_limits<double>::max()))
        ->type_name("SPACING");
    app.add_option("--every", read.filter.every, "Of every N points the first (default 1)")
        ->check(range(std::uint64_t{1}, std::uint64_t{1} << 40))
        ->type_name("N");
    app.add_option_function<int>(
           "--level", [&](int level) { read.level = level; },
           "Levels of detail of COPC files down to N, 0 the coarsest (default: all)")
        ->check(range(0, 64))
        ->type_name("N");
    addParsed(app, "--transform", "A 4x4 matrix in a file that all inputs go through", [&](const std::string& text) {
        read.transform = readTransform(text);
    })->type_name("FILE");
    addParsed(app, "--up",
              "Which way is up in the scan's coordinates (default auto: as the files say, else as the surface shows)",
              [&](const std::string& text) { options.up = parseUp(text); })
        ->type_name("auto|x|y|z|-x|-y|-z");
    addParsed(app, "--attributes",
              "What else scans have of their points: all of it, nothing, or names, as "
              "intensity,classification (default auto)",
              [&](const std::string& text) { read.attributes = parseAttributes(text); })
        ->type_name("auto|none|NAMES");
}

void addSurfaceOptions(CommandLine& app, BakeOptions& options) {
    app.option_defaults()->group("Surface");
    auto& surface = options.surface;
    addChoice(app, "--normals", surface.normals, kNormalSources,
              "Normals; auto estimates what is missing (default auto)");
    app.add_option("--neighbors", surface.neighbors, "Neighbours of a normal estimate, 3 to 255 (default 16)")
        ->check(range(3, 255))
        ->type_name("K");
    addChoice(app, "--orient", surface.orient, kOrientModes,
              "Their side; auto takes sensors where known, up for airborne lidar, else a minimum spanning tree; none: "
              "either, and points are not smoothed (default auto)");
    app.add_option("--radius-scale", surface.radius_scale, "Multiplies the radii, 0.01 to 100 (default 1)")
        ->check(range(0.01, 100.0))
        ->type_name("S");
    addChoice(app, "--outliers", surface.remove_outliers, kOutlierModes, "Points far off any surface (default remove)");
    addParsed(app, "--clean", "Noise: auto smooths scans that have some, a number that much stronger (default auto)",
              [&](const std::string& text) { surface.clean = parseClean(text); })
        ->type_name("auto|off|STRENGTH");
    app.add_option("--reflectivity", options.reflectivity, "Of the material, 0 matte to 1 mirror (default 0)")
        ->check(range(0.0, 1.0))
        ->type_name("R");
}

void addOctreeOptions(CommandLine& app, BakeOptions& options) {
    app.option_defaults()->group("Octree");
    app.add_option("--max-leaf-splats", options.octree.max_leaf_splats,
                   "Members before a leaf more than 11 radii wide splits, 1 to 65535 (default 8)")
        ->check(range(1u, PRO_LEAF_LIST_MAX))
        ->type_name("N");
    app.add_option("--max-depth", options.octree.max_depth, "Levels below the root, 0 to 21 (default 21)")
        ->check(range(0u, PRO_MAX_DEPTH))
        ->type_name("N");
    addChoice(app, "--prune", options.prune, kSwitch,
              "Drop references that probe rays show to be needless (default on)");
    app.add_option("--probe-rays", options.pruning.probe_rays, "Probes a leaf, 1 to 65536 (default 64)")
        ->check(range(1u, 65536u))
        ->type_name("N");
    app.add_option("--prune-harm", options.pruning.harm,
                   "Share of rays whose hit pruning may move by 1% of a radius, 1e-7 to 0.5 (default 0.0001)")
        ->check(range(1e-7, 0.5))
        ->type_name("H");
}

void addTileSetOptions(CommandLine& app, BakeOptions& options) {
    app.option_defaults()->group("Tile sets, -o NAME.proset; steps leave their work in NAME.proset.work");
    TileSetOptions& tiles = options.tiles;
    addParsed(app, "--max-memory", "What a bake stays below, as 4G or 800M, from 512M (default 4G)",
              [&](const std::string& text) { tiles.max_memory = parseBytes("--max-memory", text); })
        ->type_name("SIZE");
    app.add_option("--tile-splats", tiles.points_per_tile, "Points a tile, about, 1000 to 100000000 (default 1000000)")
        ->check(range(std::uint64_t{1000}, std::uint64_t{100'000'000}))
        ->type_name("N");
    addParsed(
        app, "--step",
        "One step only: plan, split, block:N of each block, levels, tile:N of each block, top; plan says how many "
        "blocks there are",
        [&](const std::string& text) { parseSetStep(text, tiles); })
        ->type_name("STEP");
    completes(app, "--step", setStepWords());
    app.add_flag("--keep-work", tiles.keep_work, "Leave NAME.proset.work where it is in the end");
}

void addReportOptions(CommandLine& app, BakeOptions& options) {
    app.option_defaults()->group("Running and reporting");
    app.add_option("-j,--threads", options.threads, "Threads, 0 to 4096, 0 uses all cores (default 0)")
        ->check(range(0, 4096))
        ->type_name("N");
    app.add_option("--stats", options.stats_path, "Write figures as JSON, - for standard output (default: none)")
        ->type_name("FILE");
    completes(app, "--stats", ".json");
    addChoice(app, "--progress", options.progress, kProgressStyles,
              "On standard error; lines: 'progress SHARE STAGE POINTS_PER_SECOND' for programs (default auto)");
    app.add_flag_callback(
        "-q,--quiet", [&] { options.verbosity = Verbosity::kQuiet; },
        "No progress, but what --progress lines asks for; only errors");
    app.add_flag_callback(
        "-v,--verbose", [&] { options.verbosity = Verbosity::kDetailed; }, "More detail on standard error");
}

void checkOutputName(const BakeOptions& options) {
    const auto usage = [](const std::string& text) { throw Error(ExitCode::kBadUsage, text); };
    const std::string suffix = ".pro", set_suffix = ".proset", &output = options.output;
    const std::filesystem::path path(output);
    if (output.empty()) {
        const bool forgotten = options.inputs.size() > 1 &&
                               (options.inputs.back().ends_with(suffix) || options.inputs.back().ends_with(set_suffix));
        usage("no output is given: -o FILE.pro" +
              (forgotten ? ", did you mean -o " + options.inputs.back() + "?" : ""));
    }
    if (output == "-") usage("-o -: a .pro is mapped where it lies, so it must be a file: -o FILE.pro");
    if (path.extension() != suffix && path.extension() != set_suffix) // which a hidden file called .pro has not
        usage(output + ": the output's name must end in .pro or .proset");
}

void checkTileSetOptions(const CommandLine& app, BakeOptions& options) {
    const std::string slashed = ".proset/"; // as shells complete the names of folders
    if (options.output.ends_with(slashed)) options.output.pop_back();
    if (options.isTileSet()) return;
    for (const char* name : {"--max-memory", "--tile-splats", "--step", "--keep-work"})
        if (app.count(name) > 0)
            throw Error(ExitCode::kBadUsage, std::string(name) + " is for tile sets: -o NAME.proset");
}

void checkOptions(BakeOptions& options) {
    const auto usage = [](const std::string& text) { throw Error(ExitCode::kBadUsage, text); };
    checkOutputName(options);
    if (std::count(options.inputs.begin(), options.inputs.end(), "-") > 1)
        usage("-: standard input can be read only once");
    if (!std::isfinite(options.surface.radius_scale)) usage("--radius-scale: must be a number");
    if (!std::isfinite(options.reflectivity)) usage("--reflectivity: must be a number");
    options.pruning.seed = options.read.seed;
}

} // namespace

std::size_t threadCount(const BakeOptions& options) {
    return options.threads > 0 ? static_cast<std::size_t>(options.threads)
                               : std::max(1u, std::thread::hardware_concurrency());
}

std::string choiceName(NormalSource source) { return nameIn(kNormalSources, source); }
std::string choiceName(OrientMode mode) { return nameIn(kOrientModes, mode); }

bool parseOptions(int argc, char** argv, BakeOptions& options) {
    CommandLine app{"Bakes point scans into a .pro file that pointrt-view ray traces.\nReads " + readableFormats() +
                        " sets.",
                    "pointrt-bake"};
    app.option_defaults()->multi_option_policy(CLI::MultiOptionPolicy::TakeLast);
    addInputOptions(app, options);
    addFilterOptions(app, options);
    addSurfaceOptions(app, options);
    addOctreeOptions(app, options);
    addTileSetOptions(app, options);
    addReportOptions(app, options);
    addCommonOptions(app, POINTRT_VERSION, "a scan is wrong", kExamples); // under the last heading
    if (parseCommandLine(app, argc, argv)) return false;
    if (app.count("--quiet") > 0 && app.count("--verbose") > 0)
        throw Error(ExitCode::kBadUsage, "-q and -v exclude each other");
    checkTileSetOptions(app, options);
    for (const char* const probing : {"--probe-rays", "--prune-harm"})
        if (!options.prune && app.count(probing) > 0)
            throw Error(ExitCode::kBadUsage, std::string(probing) + ": goes with --prune on");
    checkOptions(options);
    options.inputs = filesOf(options.inputs);
    return true;
}

} // namespace pointrt

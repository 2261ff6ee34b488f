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
#include "preprocess/input/input_formats.h"

namespace pointrt {

namespace {

const std::map<std::string, NormalSource> kNormalSources{
    {"auto", NormalSource::kAuto}, {"keep", NormalSource::kKeep}, {"estimate", NormalSource::kEstimate}};
const std::map<std::string, OrientMode> kOrientModes{{"auto", OrientMode::kAuto},
                                                     {"sensor", OrientMode::kSensor},
                                                     {"mst", OrientMode::kMst},
                                                     {"up", OrientMode::kUp},
                                                     {"none", OrientMode::kNone}};
const std::map<std::string, SplatShape> kSplatShapes{
    {"auto", SplatShape::kAuto}, {"disc", SplatShape::kDisc}, {"ball", SplatShape::kBall}};
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
                throw CLI::ValidationError(name, "'" + text + "' is not one of " + joined(choices));
            },
            help)
        ->type_name(joined(choices));
}

constexpr const char* kExamples =
    "  pointrt-bake scan.ply -o scan.pro\n"
    "  pointrt-bake a.ply b.pcd -o all.pro               two scans that share coordinates\n"
    "  pointrt-bake tiles/ --classes 2,6 -o city.pro     ground and buildings in a folder of tiles\n"
    "  pointrt-bake mesh.obj --sample 1000000 -o mesh.pro\n"
    "  zcat scan.xyz.gz | pointrt-bake - -f -o scan.pro\n";

/// A range check without a description, since the option's help states the range.
template <typename Value>
CLI::Validator range(Value low, Value high) {
    return CLI::Range(low, high).description("");
}

/// Refuses negative numbers, as CLI11 reads -1 as 2^64 - 1.
CLI::Validator notNegative() {
    return {[](const std::string& text) { return text.starts_with('-') ? text + " is negative" : std::string(); }, ""};
}

void addInputFormat(CommandLine& app, std::string& format) {
    std::vector<std::string> names;
    for (const InputFormat& each : inputFormats()) names.emplace_back(each.name);
    std::string list = names.front();
    for (std::size_t i = 1; i < names.size(); ++i) list += (i + 1 < names.size() ? ", " : " or ") + names[i];
    app.add_option("--input-format", format, "Input format: " + list + " (default: detected from the content)")
        ->check(CLI::IsMember(names).description(""))
        ->type_name("NAME");
    completes(app, "--input-format", joinedWords(names, " "));
}

/// The suffixes of all formats, plain and gzipped.
std::string scanSuffixes() {
    std::string list;
    for (const InputFormat& each : inputFormats())
        forSuffixes(each, [&](std::string_view suffix) {
            list += "." + std::string(suffix) + " ." + std::string(suffix) + ".gz ";
        });
    return list;
}

void addInputOptions(CommandLine& app, BakeOptions& options) {
    app.option_defaults()->group("Input and output");
    app.add_option("SCAN", options.inputs,
                   "Scan files or folders of them, merged into one point cloud; - reads standard input")
        ->required()
        ->type_name("")
        ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll);
    completes(app, "SCAN", scanSuffixes());
    app.add_option(
           "-o,--output", options.output,
           "Output: a .pro file, or a folder NAME.proset of tiles for scans of any size; existing output is kept "
           "unless -f is given")
        ->type_name("FILE")
        ->option_text("FILE REQUIRED");
    completes(app, "--output", ".pro .proset");
    app.add_flag("-f,--force", options.force, "Overwrite existing output");
    app.add_flag_callback(
        "--compact", [&] { options.index = false; },
        "Omit the tracing index: the file is less than half the size, but pointrt-view takes longer to open it");
    addInputFormat(app, options.read.format);
    app.add_option_function<std::uint64_t>(
           "--sample", [&](std::uint64_t count) { options.read.sample_count = count; },
           "Number of points to sample on the faces of a mesh, up to 2000000000; 0 uses its vertices (default: sample "
           "only if the vertices are too sparse)")
        ->check(range(std::uint64_t{0}, std::uint64_t{2000000000}))
        ->check(notNegative())
        ->type_name("N");
    app.add_option("--seed", options.read.seed,
                   "Random seed for mesh samples and probe rays, 0 to 2^64 - 1 (default 0)")
        ->check(notNegative())
        ->type_name("N");
}

/// Adds an option whose text is parsed by take(text).
template <typename Take>
CLI::Option* addParsed(CommandLine& app, const std::string& name, const std::string& help, const Take& take) {
    return app.add_option_function<std::string>(name, take, help);
}

void addFilterOptions(CommandLine& app, BakeOptions& options) {
    app.option_defaults()->group("Points to read and their coordinates");
    auto& read = options.read;
    addParsed(app, "--bounds", "Keep only points inside this box, in scan coordinates", [&](const std::string& text) {
        read.filter.bounds = parseBounds(text);
    })->type_name("MINX,MINY,MINZ,MAXX,MAXY,MAXZ");
    CLI::Option* const classes =
        addParsed(app, "--classes", "Keep only points of these classes, e.g. 2,6 or 3-5", [&](const std::string& text) {
            read.filter.keep_classes = parseClasses("--classes", text);
        })->type_name("LIST");
    addParsed(app, "--drop-classes", "Drop points of these classes",
              [&](const std::string& text) {
                  read.filter.keep_classes = parseClasses("--drop-classes", text);
                  read.filter.keep_classes.flip();
              })
        ->type_name("LIST")
        ->excludes(classes);
    app.add_option("--thin", read.filter.thin_spacing,
                   "Thin the points: keep one in each cube of a grid with this edge length")
        ->check(range(std::numeric_limits<double>::min(), std::numeric_limits<double>::max()))
        ->type_name("SPACING");
    app.add_option("--every", read.filter.every, "Keep every N-th point (default 1)")
        ->check(range(std::uint64_t{1}, std::uint64_t{1} << 40))
        ->type_name("N");
    app.add_option_function<int>(
           "--level", [&](int level) { read.level = level; },
           "Read COPC, EPT, Potree and SOG files down to level of detail N, where 0 is the coarsest (default: all "
           "levels)")
        ->check(range(0, 64))
        ->type_name("N");
    app.add_option("--skim", read.skim,
                   "Preview large LAZ files in seconds: read only this fraction of the points of each chunk, from its "
                   "start (default 1: all)")
        ->check(range(1e-6, 1.0))
        ->type_name("SHARE");
    app.add_flag("--salvage", read.salvages,
                 "Read the intact points of files that are truncated or have fewer points than their header says "
                 "(default: refuse such files)");
    app.add_flag_callback(
        "--keep-withheld", [&] { read.drops_withheld = false; },
        "Keep points that LAS files flag as withheld (default: leave them out)");
    addParsed(app, "--transform", "Apply the 4x4 matrix in this text file (16 numbers, row by row) to all inputs",
              [&](const std::string& text) { read.transform = readTransform(text); })
        ->type_name("FILE");
    addParsed(app, "--up",
              "Up axis in scan coordinates; auto: as the files say, else estimated from the surface, else z for points "
              "and y for meshes (default auto)",
              [&](const std::string& text) { options.up = parseUp(text); })
        ->type_name("auto|x|y|z|-x|-y|-z");
    addParsed(app, "--attributes",
              "Extra per-point attributes to keep: auto (all), none, or a list, e.g. intensity,classification "
              "(default auto)",
              [&](const std::string& text) { read.attributes = parseAttributes(text); })
        ->type_name("auto|none|NAMES");
}

void addSurfaceOptions(CommandLine& app, BakeOptions& options) {
    app.option_defaults()->group("Surface");
    auto& surface = options.surface;
    addChoice(app, "--normals", surface.normals, kNormalSources,
              "Keep or estimate normals; auto: estimate missing ones (default auto)");
    app.add_option("--neighbors", surface.neighbors,
                   "Number of neighbours for normal estimation, 3 to 255 (default 16)")
        ->check(range(3, 255))
        ->type_name("K");
    addChoice(
        app, "--orient", surface.orient, kOrientModes,
        "Orient normals; auto: towards known sensors, upwards for airborne lidar, else by a minimum spanning tree; "
        "none: leave them unoriented, which also turns off smoothing (default auto)");
    addChoice(app, "--splat", surface.splat, kSplatShapes,
              "Shape of splats. disc: discs on the estimated surface. ball: balls that touch their neighbours, at the "
              "points as measured, without smoothing. auto: discs, but balls for points without normals that lie on no "
              "surface (default auto)");
    app.add_option("--radius-scale", surface.radius_scale, "Scale splat radii by this factor, 0.01 to 100 (default 1)")
        ->check(range(0.01, 100.0))
        ->type_name("S");
    addChoice(app, "--outliers", surface.remove_outliers, kOutlierModes,
              "Remove or keep points far from any surface (default remove)");
    addParsed(app, "--clean", "Smooth noisy scans; a number from 0.1 to 10 scales the strength of auto (default auto)",
              [&](const std::string& text) { surface.clean = parseClean(text); })
        ->type_name("auto|off|STRENGTH");
    app.add_option("--reflectivity", options.reflectivity,
                   "Reflectivity of the surface, from 0 (matte) to 1 (mirror) (default 0)")
        ->check(range(0.0, 1.0))
        ->type_name("R");
}

void addOctreeOptions(CommandLine& app, BakeOptions& options) {
    app.option_defaults()->group("Octree");
    app.add_option("--max-leaf-splats", options.octree.max_leaf_splats,
                   "Split leaves wider than 11 radii that have more than N splats, 1 to 65535 (default 8)")
        ->check(range(1u, PRO_LEAF_LIST_MAX))
        ->type_name("N");
    app.add_option("--max-depth", options.octree.max_depth, "Maximum depth of the octree, 0 to 21 (default 21)")
        ->check(range(0u, PRO_MAX_DEPTH))
        ->type_name("N");
    addChoice(app, "--prune", options.prune, kSwitch,
              "Drop splat references that probe rays show to be unnecessary (default on)");
    app.add_option("--probe-rays", options.pruning.probe_rays, "Probe rays per leaf, 1 to 65536 (default 64)")
        ->check(range(1u, 65536u))
        ->type_name("N");
    app.add_option(
           "--prune-harm", options.pruning.harm,
           "Largest fraction of rays whose hits may move by more than 1 % of a splat radius due to pruning, 1e-7 to "
           "0.5 (default 0.0001)")
        ->check(range(1e-7, 0.5))
        ->type_name("H");
}

void addTileSetOptions(CommandLine& app, BakeOptions& options) {
    app.option_defaults()->group("Tile sets (-o NAME.proset); intermediate files go to NAME.proset.work");
    TileSetOptions& tiles = options.tiles;
    addParsed(app, "--max-memory", "Memory limit, e.g. 4G or 800M, at least 512M (default 4G)",
              [&](const std::string& text) { tiles.max_memory = parseBytes("--max-memory", text); })
        ->type_name("SIZE");
    app.add_option("--tile-splats", tiles.points_per_tile,
                   "Approximate number of points per tile, 1000 to 100000000 (default 1000000)")
        ->check(range(std::uint64_t{1000}, std::uint64_t{100'000'000}))
        ->type_name("N");
    addParsed(app, "--step",
              "Run only one step of the bake. The steps in order: plan (prints the number of blocks), split, block:N "
              "for each block, levels, tile:N for each block, top",
              [&](const std::string& text) { parseSetStep(text, tiles); })
        ->type_name("STEP");
    completes(app, "--step", setStepWords());
    app.add_flag("--keep-work", tiles.keep_work, "Keep NAME.proset.work after the bake");
}

void addReportOptions(CommandLine& app, BakeOptions& options) {
    app.option_defaults()->group("Running and reporting");
    app.add_option("-j,--threads", options.threads, "Number of threads, up to 4096; 0: one per core (default 0)")
        ->check(range(0, 4096))
        ->type_name("N");
    app.add_option("--stats", options.stats_path, "Write statistics as JSON to this file; - for standard output")
        ->type_name("FILE");
    completes(app, "--stats", ".json");
    addChoice(
        app, "--progress", options.progress, kProgressStyles,
        "Progress on standard error; lines: 'progress FRACTION STAGE POINTS_PER_SECOND' for programs (default auto)");
    app.add_flag_callback(
        "-q,--quiet", [&] { options.verbosity = Verbosity::kQuiet; },
        "Print only errors, and progress with --progress lines");
    app.add_flag_callback(
        "-v,--verbose", [&] { options.verbosity = Verbosity::kDetailed; }, "Print more detail to standard error");
}

void checkOutputName(const BakeOptions& options) {
    const std::string suffix = ".pro", set_suffix = ".proset", &output = options.output;
    const std::filesystem::path path(output);
    if (output.empty()) {
        const bool forgotten = options.inputs.size() > 1 &&
                               (options.inputs.back().ends_with(suffix) || options.inputs.back().ends_with(set_suffix));
        refuseUsage("no output given; use -o FILE.pro" +
                    (forgotten ? ", did you mean -o " + options.inputs.back() + "?" : ""));
    }
    if (output == "-")
        refuseUsage("-o -: a .pro is memory-mapped, so it cannot go to standard output; use -o FILE.pro");
    if (path.extension() != suffix && path.extension() != set_suffix) // a hidden file ".pro" has no extension
        refuseUsage(output + ": the output name must end in .pro or .proset");
}

void checkTileSetOptions(const CommandLine& app, BakeOptions& options) {
    const std::string slashed = ".proset/"; // the way shells complete folder names
    if (options.output.ends_with(slashed)) options.output.pop_back();
    if (options.isTileSet()) return;
    for (const char* name : {"--max-memory", "--tile-splats", "--step", "--keep-work"})
        if (app.count(name) > 0) refuseUsage(std::string(name) + " applies only to tile sets (-o NAME.proset)");
}

void checkOptions(BakeOptions& options) {
    checkOutputName(options);
    if (std::count(options.inputs.begin(), options.inputs.end(), "-") > 1)
        refuseUsage("-: standard input can be read only once");
    if (!std::isfinite(options.surface.radius_scale)) refuseUsage("--radius-scale: must be finite");
    if (!std::isfinite(options.reflectivity)) refuseUsage("--reflectivity: must be finite");
    options.pruning.seed = options.read.seed;
    options.read.gaussians_as_discs |= options.surface.splat == SplatShape::kDisc;
}

} // namespace

std::size_t threadCount(const BakeOptions& options) {
    return options.threads > 0 ? static_cast<std::size_t>(options.threads)
                               : std::max(1u, std::thread::hardware_concurrency());
}

std::string choiceName(NormalSource source) { return nameIn(kNormalSources, source); }
std::string choiceName(OrientMode mode) { return nameIn(kOrientModes, mode); }
std::string choiceName(SplatShape splat) { return nameIn(kSplatShapes, splat); }

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
    addCommonOptions(app, POINTRT_VERSION, "a scan is malformed or empty", kExamples); // after the last heading
    if (parseCommandLine(app, argc, argv)) return false;
    if (app.count("--quiet") > 0 && app.count("--verbose") > 0)
        throw Error(ExitCode::kBadUsage, "-q and -v cannot be combined");
    checkTileSetOptions(app, options);
    for (const char* const probing : {"--probe-rays", "--prune-harm"})
        if (!options.prune && app.count(probing) > 0)
            throw Error(ExitCode::kBadUsage, std::string(probing) + " requires --prune on");
    checkOptions(options);
    options.inputs = filesOf(options.inputs);
    return true;
}

} // namespace pointrt

// SPDX-License-Identifier: Apache-2.0
#include "runtime/session/options.h"

#include <algorithm>
#include <array>
#include <functional>
#include <span>
#include <stdexcept>
#include <string_view>

#include "format/base/error.h"
#include "format/base/require_pro.h"
#include "format/cli/command_line.h"
#include "format/os/desktop.h"
#include "runtime/scene/panorama.h"
#include "runtime/scene/turntable.h"
#include "runtime/scene_io/scene_file.h"
#include "runtime/session/option_table.h"

namespace pointrt {
namespace {

constexpr const char* kExamples = "  pointrt-view scan.ply               open a window; press H for the keys\n"
                                  "  pointrt-view scan.ply -o scan.png   render a picture, lit by studio lamps\n"
                                  "  pointrt-view a.ply b.pcd -o all.png --bake --clean off\n"
                                  "  pointrt-view scan.pro --integrator path --time-limit 60 -o scan.png\n"
                                  "  pointrt-view scene.toml --view top -o - | convert - top.jpg\n";
/// What shells complete: scenes, and the most common formats of scans.
constexpr const char* kSceneSuffixes =
    ".pro .proset .toml .las .laz .e57 .ply .pcd .ptx .pts .xyz .obj .stl .glb .spz .sog .splat .conf .bag .mcap";
constexpr const char* kNotes =
    "Ctrl-C stops rendering and saves the partial picture (continue an EXR with --resume); the exit status is that of "
    "the signal. A second Ctrl-C quits at once.\n\n"
    "PNGs are written as they are rendered and need at most 1.3 GiB of memory. EXRs, turntables, and pictures with "
    "--time-limit or --noise need 112 bytes per pixel; pointrt-view refuses to start if memory is insufficient.\n\n"
    "Scans are baked by pointrt-bake, which must be beside this program or in PATH. The results are cached in "
    "~/.cache/pointrt/bakes and reused for the same files and options. If the cache exceeds POINTRT_BAKE_CACHE (e.g. "
    "50G, or off; default 20G) or a quarter of the free disk space, the least recently used files are deleted. "
    "Deleting the folder clears the cache.\n\n"
    "Environment variables: POINTRT_INDEX_CACHE limits the cache in ~/.cache/pointrt/index, which holds the tracing "
    "indices built for files without one (e.g. 20G, or off; default 8G). POINTRT_VALIDATION=1 enables the Vulkan "
    "validation layer; any message ends the run with exit code 3.";

/// Adds an option that passes its text to set. An std::invalid_argument from set becomes the error "NAME: reason".
void add(CommandLine& app, const std::string& names, const char* placeholder, const std::string& help,
         const std::string& candidates, const std::function<void(const std::string&)>& set) {
    const std::string name = names.substr(names.rfind(',') == std::string::npos ? 0 : names.rfind(',') + 1);
    auto callback = [set, name](const std::string& text) {
        try {
            set(text);
        } catch (const std::invalid_argument& error) {
            throw Error{ExitCode::kBadUsage, name + ": " + error.what()};
        }
    };
    app.add_option_function<std::string>(names, callback, help)->type_name(placeholder);
    completes(app, name, candidates);
}

/// An option that may be given several times, each with one value.
void addRepeated(CommandLine& app, const OptionRow& row, Options& options) {
    const auto setAll = [&options, set = row.set, name = row.names](const std::vector<std::string>& texts) {
        for (const std::string& text : texts) try {
                set(options, text);
            } catch (const std::invalid_argument& error) {
                throw Error{ExitCode::kBadUsage, std::string(name) + ": " + error.what()};
            }
    };
    app.add_option_function<std::vector<std::string>>(row.names, setAll, row.help)
        ->type_name(row.placeholder)
        ->allow_extra_args(false)
        ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll);
}

void addRow(CommandLine& app, const OptionRow& row, Options& options) {
    if (row.flag)
        app.add_flag(row.names, options.*row.flag, row.help);
    else if (row.repeats)
        addRepeated(app, row, options);
    else
        add(app, row.names, row.placeholder, row.help, row.completes,
            [&options, set = row.set](const std::string& text) { set(options, text); });
}

std::string replaced(std::string text, const std::string& what, const std::string& with) {
    const std::size_t at = text.find(what);
    return at == std::string::npos ? text : text.replace(at, what.size(), with);
}

template <typename Row>
std::string helpOf(const Row& row) {
    const auto standard = settingOf(RenderSettings{}, row.member);
    const std::string help = replaced(row.command_line.help, "{limits}", limitsText(row.limits));
    return standard ? replaced(help, "{default}", valueText(row.limits, *standard)) : help;
}

/// The values of a setting that shells complete, separated by spaces.
template <typename Limits>
std::string candidatesOf(const Limits&) {
    return {};
}
template <typename Named>
std::string candidatesOf(const OneOf<Named>& limits) {
    return joinedNames(limits.names, " ");
}
std::string candidatesOf(const AttributeWord&) { return "rgb height normal scan intensity class"; }
std::string candidatesOf(const BackgroundWord&) { return "black white transparent"; }

void addSettings(CommandLine& app, HelpGroup group, RenderChoices& choices) {
    forEachRenderSetting([&](const auto& row) {
        if (row.command_line.group != group) return;
        add(app, row.command_line.option, row.command_line.placeholder, helpOf(row), candidatesOf(row.limits),
            [&choices, &row](const std::string& text) { choices.*row.choice = parseValue(row.limits, text); });
    });
}

void addGroups(CommandLine& app, Options& options) {
    for (const OptionGroup& group : optionGroups()) {
        app.option_defaults()->group(group.heading);
        for (const OptionRow& row : group.options) addRow(app, row, options);
        if (group.settings) addSettings(app, *group.settings, options.choices);
    }
    addCommonOptions(app, POINTRT_VERSION, "the scene is unreadable, malformed or empty", kExamples,
                     kNotes); // after the last heading
}

void requireOutput(bool given, bool fits, const char* option, const char* suffix) {
    if (given && !fits) throw Error{ExitCode::kBadUsage, std::string(option) + ": needs -o FILE" + suffix};
}

/// Refuses to write two outputs to standard output.
void requireOwnStream(const Options& options) {
    const char* other = options.bench_frames != 0 ? "--bench" : options.stats == "-" ? "--stats -" : nullptr;
    if (options.output == "-" && other)
        throw Error{ExitCode::kBadUsage,
                    std::string("-o - and ") + other + " cannot be combined: both write to standard output"};
}

void requireWindow(const Options& options) {
    const char* option = !options.record.empty() ? "--record" : !options.replay.empty() ? "--replay" : "--offscreen";
    const bool any = !options.record.empty() || !options.replay.empty() || options.offscreen;
    if (any && !opensWindow(options))
        throw Error{ExitCode::kBadUsage, std::string(option) + " is for the window: omit -o and --bench"};
    if (options.offscreen && options.replay.empty())
        throw Error{ExitCode::kBadUsage, "--offscreen needs --replay FILE: an invisible window cannot be closed"};
    if (!options.record.empty() && options.record == options.replay)
        throw Error{ExitCode::kBadUsage, "--record and --replay name the same file"};
    if (opensWindow(options) && options.profile)
        throw Error{ExitCode::kBadUsage, "--profile needs -o FILE or --bench: the window's frames are not profiled"};
    if (opensWindow(options) && (options.limits.seconds || options.limits.noise))
        throw Error{ExitCode::kBadUsage, "--time-limit and --noise need -o FILE: the window refines up to --spp"};
}

void requireImage(const Options& options) {
    const std::string& path = options.output;
    if (!path.empty() && !writesToneMapped(options) && !path.ends_with(".exr"))
        throw Error{ExitCode::kBadUsage,
                    path + ": files must end in .png, .tif or .exr, or for moving cameras in .mp4 or .webm"};
}

/// Refuses options that the cameras of a list set themselves, and options that need a single picture.
void requireCameraList(const Options& options) {
    if (options.output.empty() || options.output == "-") throw Error{ExitCode::kBadUsage, "--cameras: needs -o FOLDER"};
    const CameraRequest& camera = options.camera;
    const char* other = options.turntable != 0                   ? movingOption(options.follows_views)
                        : options.bench_frames != 0              ? "--bench"
                        : options.resume                         ? "--resume"
                        : options.profile                        ? "--profile"
                        : !options.view.empty()                  ? "--view"
                        : camera.eye                             ? "--eye"
                        : camera.target                          ? "--target"
                        : options.fov_deg                        ? "--fov"
                        : camera.ortho                           ? "--ortho"
                        : options.choices.legend.value_or(false) ? "--legend"
                                                                 : nullptr;
    if (other) throw Error{ExitCode::kBadUsage, std::string("--cameras and ") + other + " cannot be combined"};
    if (options.camera_output.depth_unit && !options.camera_output.depth)
        throw Error{ExitCode::kBadUsage, "--depth-unit: needs the depth layer, which --layers omits"};
}

/// Refuses options that only affect lists of cameras.
void requireNoCameraList(const Options& options) {
    requireImage(options);
    if (options.camera_output != CameraOutput{} || options.drops_distortion)
        throw Error{ExitCode::kBadUsage, "--layers, --depth-unit and --distortion need --cameras"};
}

void requireThumbnail(const Options& options) {
    if (options.output.empty()) throw Error{ExitCode::kBadUsage, "--thumbnail: needs -o FILE"};
    const char* other = options.choices.size               ? "--size"
                        : options.turntable != 0           ? movingOption(options.follows_views)
                        : options.bench_frames != 0        ? "--bench"
                        : options.resume                   ? "--resume"
                        : !options.cameras.empty()         ? "--cameras"
                        : options.output.ends_with(".exr") ? "-o FILE.exr"
                                                           : nullptr;
    if (other) throw Error{ExitCode::kBadUsage, std::string("--thumbnail and ") + other + " cannot be combined"};
}

/// Fills in the settings of a thumbnail that are not given. The time limit is for scenes with slow samples.
void fillThumbnail(Options& options) {
    constexpr double kSeconds = 1; // file managers render thumbnails of whole folders
    options.choices.size = PixelSize{options.thumbnail, options.thumbnail};
    if (!options.choices.spp) options.choices.spp = RenderSettings{}.spp;
    if (!options.limits.seconds) options.limits.seconds = kSeconds;
    options.quiet = !options.verbose;
}

/// Refuses options that conflict with a plan, which sets its own camera.
void requirePlan(const Options& options) {
    const CameraRequest& camera = options.camera;
    const char* other = options.turntable != 0                   ? movingOption(options.follows_views)
                        : options.thumbnail != 0                 ? "--thumbnail"
                        : !options.cameras.empty()               ? "--cameras"
                        : options.resume                         ? "--resume"
                        : !options.view.empty()                  ? "--view"
                        : camera.eye                             ? "--eye"
                        : camera.up && !options.up_axis          ? "--up"
                        : options.fov_deg                        ? "--fov"
                        : camera.ortho                           ? "--ortho"
                        : camera.target && !options.choices.size ? "--target without --size"
                                                                 : nullptr;
    if (other) throw Error{ExitCode::kBadUsage, std::string("--plan and ") + other + " cannot be combined"};
    if (!writesToneMapped(options) || options.output == "-")
        throw Error{ExitCode::kBadUsage, "--plan: needs -o FILE.png or FILE.tif"};
}

/// Refuses options that conflict with a panorama, which has no lens and a fixed aspect.
void requirePanorama(const Options& options) {
    if (!options.panorama) throw Error{ExitCode::kBadUsage, "--stereo: needs --panorama"};
    if (opensWindow(options)) throw Error{ExitCode::kBadUsage, "--panorama: needs -o FILE.png, FILE.tif or FILE.exr"};
    const char* other = options.plan > 0           ? "--plan"
                        : options.thumbnail != 0   ? "--thumbnail"
                        : !options.cameras.empty() ? "--cameras"
                        : options.fov_deg          ? "--fov"
                        : options.camera.ortho     ? "--ortho"
                                                   : nullptr;
    if (other) throw Error{ExitCode::kBadUsage, std::string("--panorama and ") + other + " cannot be combined"};
    const bool in_stereo = options.camera.eyes_apart_m > 0;
    const PixelSize size = options.choices.size.value_or(PixelSize{});
    if (options.choices.size && (size.width % 2 != 0 || !(size == panoramaSize(size.width, in_stereo))))
        throw Error{ExitCode::kBadUsage, in_stereo ? "--size: a panorama in stereo is square, such as 2048x2048"
                                                   : "--size: a panorama is twice as wide as high, such as 2048x1024"};
}

void fillPanorama(Options& options) {
    constexpr std::uint32_t kWidth = 2048; // sharp enough to look around on a screen, at two megapixels
    options.camera.panorama = true;
    if (!options.choices.size) options.choices.size = panoramaSize(kWidth, options.camera.eyes_apart_m > 0);
}

/// Refuses other options with --device list.
void requireNothingElse(const Options& options) {
    if (!options.inputs.empty() || !options.output.empty() || options.bench_frames != 0)
        throw Error{ExitCode::kBadUsage, "--device list cannot be combined with other options"};
}

/// Options of pointrt-bake that are refused after --bake, since they need a named output.
constexpr std::array kNotBehind = {"-o", "--output", "--step", "--keep-work", "--progress", "--generate"};

void requireBakeOptions(const Options& options) {
    for (const std::string_view option : options.bake_options)
        for (const std::string_view refused : kNotBehind)
            if (option.substr(0, option.find('=')) == refused)
                throw Error{ExitCode::kBadUsage,
                            "--bake: " + std::string(refused) + " cannot be used here; run pointrt-bake"};
}

/// Without a scene, a window opens with a page to start from, if there is a desktop or a recording.
void requireStartPage(const Options& options) {
    const bool can_show = hasDesktop() || !options.replay.empty();
    if (!opensWindow(options) || !can_show) throw Error{ExitCode::kBadUsage, "no SCENE given"};
}

/// Refuses several scenes if one is a scene file, and baked scans together with scans to bake.
void requireInputs(const Options& options) {
    if (options.inputs.empty()) return requireStartPage(options);
    for (const std::string& input : std::span(options.inputs).subspan(1))
        if (input.ends_with(".png") || input.ends_with(".tif") || input.ends_with(".exr"))
            throw Error{ExitCode::kBadUsage, "unexpected argument " + input + ", did you mean -o " + input + "?"};
    const auto scene = std::find_if(options.inputs.begin(), options.inputs.end(), isScene);
    if (scene == options.inputs.end()) return requireBakeOptions(options);
    if (options.inputs.size() > 1 && !areBakedScans(options.inputs))
        throw Error{ExitCode::kBadUsage, *scene + ": a scene file or a baked scan cannot be opened together with "
                                                  "files of other kinds; bake the scans first, or list them in a "
                                                  "scene file (docs/SCENES.md)"};
    if (!options.bake_options.empty()) throw Error{ExitCode::kBadUsage, "--bake: " + *scene + " is baked already"};
}

void requireTask(const Options& options) {
    if (options.quiet && options.verbose) throw Error{ExitCode::kBadUsage, "-q and -v cannot be combined"};
    if (options.fov_deg && options.camera.ortho)
        throw Error{ExitCode::kBadUsage,
                    "--fov and --ortho cannot be combined: a parallel projection has no field of view"};
    if (options.list_devices) return requireNothingElse(options);
    if (options.plan > 0) requirePlan(options);
    if (options.panorama || options.camera.eyes_apart_m > 0) requirePanorama(options);
    if (options.thumbnail != 0) requireThumbnail(options);
    if (options.cameras.empty())
        requireNoCameraList(options);
    else
        requireCameraList(options);
    requireOutput(options.resume, options.output.ends_with(".exr"), "--resume", ".exr");
    if (!opensWindow(options) && options.cameras.empty()) {
        requireOutput(options.choices.exposure.has_value(), writesToneMapped(options), "--exposure", ".png");
        requireOutput(options.choices.legend.value_or(false), writesToneMapped(options), "--legend", ".png");
    }
    requireOwnStream(options);
    if (options.resume && options.bench_frames != 0)
        throw Error{ExitCode::kBadUsage, "--resume and --bench cannot be combined"};
    if (options.turntable != 0 && (options.resume || options.bench_frames != 0))
        throw Error{ExitCode::kBadUsage, std::string(movingOption(options.follows_views)) + " and " +
                                             (options.resume ? "--resume" : "--bench") + " cannot be combined"};
    requireInputs(options);
    if (options.cameras.empty())
        requireFrameNames(options.output, options.turntable != 0 ? movingOption(options.follows_views) : nullptr);
    requireWindow(options);
}

/// Renders a video as pictures in a folder beside it.
void takeVideo(Options& options) {
    if (!isVideo(options.output)) return;
    if (options.turntable == 0)
        throw Error{ExitCode::kBadUsage, options.output + ": a video needs --turntable or --path"};
    if (options.choices.background && options.choices.background->transparent)
        throw Error{ExitCode::kBadUsage,
                    options.output + ": videos cannot be transparent; choose another --background"};
    options.video = options.output;
    options.output += ".frames/%06d.png";
}

/// If the inputs are baked already, takes the scene and further scans from them.
void takeScene(Options& options) {
    const std::vector<std::string>& inputs = options.inputs;
    if (inputs.empty() || (inputs.size() > 1 && !areBakedScans(inputs))) return;
    options.scene = inputs.front();
    options.added.assign(inputs.begin() + 1, inputs.end());
}

/// Takes the options after --bake, which belong to pointrt-bake. Returns the number of arguments before it.
int takeBakeOptions(int argc, const char* const* argv, Options& options) {
    const char* const* const end = argv + argc;
    const char* const* const bake =
        std::find_if(argv, end, [](std::string_view argument) { return argument == "--bake"; });
    if (bake + 1 == end) throw Error{ExitCode::kBadUsage, "--bake: must be followed by options of pointrt-bake"};
    if (bake != end) options.bake_options.assign(bake + 1, end);
    return static_cast<int>(bake - argv);
}

} // namespace

bool writesToneMapped(const Options& options) {
    return options.cameras.empty() && (options.thumbnail != 0 || options.output == "-" ||
                                       options.output.ends_with(".png") || options.output.ends_with(".tif"));
}

bool opensWindow(const Options& options) {
    return !options.list_devices && options.output.empty() && options.bench_frames == 0;
}

bool isScene(const std::string& path) { return path.ends_with(".pro") || isSceneOrSet(path) || beginsAsPro(path); }

const char* movingOption(bool follows_views) { return follows_views ? "--path" : "--turntable"; }

bool isVideo(const std::string& path) { return path.ends_with(".mp4") || path.ends_with(".webm"); }

bool areBakedScans(const std::vector<std::string>& paths) {
    return std::all_of(paths.begin(), paths.end(),
                       [](const std::string& path) { return isScene(path) && !isSceneFile(path); });
}

std::optional<int> parseOptions(int argc, const char* const* argv, Options& options) {
    CommandLine app("View and render point scans by ray tracing on a Vulkan device.", "pointrt-view");
    app.option_defaults()->multi_option_policy(CLI::MultiOptionPolicy::TakeLast);
    app.add_option("SCENE", options.inputs,
                   "What to render: scans (files or a folder, in any format that pointrt-bake reads), which are baked "
                   "together; or one or more FILE.pro and NAME.proset from pointrt-bake; or a scene file FILE.toml "
                   "(docs/SCENES.md), whose settings the options override")
        ->type_name("")
        ->group("Scene")
        ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll);
    completes(app, "SCENE", kSceneSuffixes);
    addGroups(app, options);
    const int own_arguments = takeBakeOptions(argc, argv, options);
    if (const auto done = parseCommandLine(app, own_arguments, argv, {{".png", "-o"}, {".exr", "-o"}})) return done;
    takeVideo(options);
    requireTask(options);
    takeScene(options);
    if (options.thumbnail != 0) fillThumbnail(options);
    if (options.panorama) fillPanorama(options);
    return {};
}

} // namespace pointrt

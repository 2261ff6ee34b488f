// SPDX-License-Identifier: Apache-2.0
#include "runtime/session/options.h"

#include <CLI/CLI.hpp>

#include <cstdio>
#include <limits>
#include <stdexcept>
#include <tuple>

#include "format/base/error.h"
#include "runtime/scene/option_values.h"
#include "runtime/scene/turntable.h"

namespace pointrt {
namespace {

constexpr std::uint32_t kMaxSize = 16384; // pixels: what image viewers and GPUs take as a texture
constexpr std::uint32_t kMaxBounces = 64;
constexpr std::uint32_t kMaxLights = 16;
constexpr std::uint32_t kMaxBenchFrames = 100000;
constexpr double kMaxSeconds = 1e7; // a third of a year
constexpr double kMaxHeight = 1e12; // as scene files take lengths
constexpr double kMaxExposure = 20; // stops: a factor of a million

const Names<bool> kProgressNames = {{"auto", false}, {"lines", true}};

std::string parseOutput(const std::string& path) {
    if (path.ends_with(".png") || path.ends_with(".exr")) return path;
    throw Error{ExitCode::kBadUsage, path + ": an image ends in .png or .exr"};
}

/// Adds an option whose text goes through set; what set throws as std::invalid_argument becomes "NAME: reason".
template <typename Set>
void add(CLI::App& app, const std::string& flags, const char* placeholder, const std::string& help, Set set) {
    const std::string name = flags.substr(flags.rfind(',') == std::string::npos ? 0 : flags.rfind(',') + 1);
    auto callback = [set, name](const std::string& text) {
        try {
            set(text);
        } catch (const std::invalid_argument& error) {
            throw Error{ExitCode::kBadUsage, name + ": " + error.what()};
        }
    };
    app.add_option_function<std::string>(flags, callback, help)->type_name(placeholder);
}

std::string defaultText(const std::string& value) { return " (default " + value + ")"; }

std::string rangeText(std::uint32_t value, std::uint32_t low, std::uint32_t high) {
    return " (default " + std::to_string(value) + ", " + std::to_string(low) + " to " + std::to_string(high) + ")";
}

/// "phong, whitted, ... (default whitted)"
template <typename Value>
std::string choiceText(const Names<Value>& names, Value value) {
    std::string text;
    for (const auto& [name, each] : names) text += (text.empty() ? "" : ", ") + std::string(name);
    return text + defaultText(nameOf(names, value));
}

void addImageOptions(CLI::App& app, Options& options) {
    app.option_defaults()->group("Image");
    RenderSettings& render = options.render;
    SceneChoices& choices = options.choices;
    add(app, "-o,--output", "FILE",
        "Render to FILE.png (8-bit sRGB) or FILE.exr (float, with first hits and the parts of the light)",
        [&](const std::string& text) {
            options.output = parseOutput(text);
            options.render.first_hits = text.ends_with(".exr");
        });
    add(app, "--turntable", "N",
        "Render N pictures with the camera going around the target once, -o frames/%04d.png (default: none, 1 to " +
            std::to_string(kMaxTurntable) + ")",
        [&](const std::string& text) { options.turntable = parseCount(text, 1, kMaxTurntable); });
    add(app, "--size", "WxH",
        "Image size in pixels (default " + std::to_string(render.width) + "x" + std::to_string(render.height) +
            ", each 1 to " + std::to_string(kMaxSize) + ")",
        [&](const std::string& text) { std::tie(choices.width, choices.height) = parseSize(text, kMaxSize); });
    add(app, "--spp", "N", "Samples a pixel; 1 samples its centre" + rangeText(render.spp, 1, kMaxSpp),
        [&](const std::string& text) { choices.spp = parseCount(text, 1, kMaxSpp); });
    const std::uint32_t max_seed = std::numeric_limits<std::uint32_t>::max();
    add(app, "--seed", "N", "Of the random numbers" + rangeText(render.seed, 0, max_seed),
        [&choices, max_seed](const std::string& text) { choices.seed = parseCount(text, 0, max_seed); });
    add(app, "--denoise", "on|off|auto",
        "Filter the noise out: a guess, for previews (default auto: PNG of soft light with fewer than 256 samples)",
        [&](const std::string& text) { choices.denoise = parseName(kDenoiseNames, text); });
    add(app, "--exposure", "STOPS", "Brighten a PNG by 2^STOPS (default 0, -20 to 20)", [&](const std::string& text) {
        choices.exposure = static_cast<float>(parseReal(text, -kMaxExposure, kMaxExposure));
    });
}

/// With one of these --spp is the most, and what a scene file says of samples is not asked.
void addQualityOptions(CLI::App& app, Options& options) {
    app.option_defaults()->group("How long");
    add(app, "--time-limit", "SECONDS",
        "Samples until the time is up, one at least (default: none; with it --spp is the most, and without --spp " +
            std::to_string(kMaxSpp) + " are)",
        [&](const std::string& text) { options.limits.seconds = parseRealAbove(text, 0, kMaxSeconds); });
    add(app, "--noise", "TARGET",
        "Samples until the relative noise of the picture is this or less, such as 0.02 (default: none; --spp as above)",
        [&](const std::string& text) { options.limits.noise = parseRealAbove(text, 0, 1); });
    app.add_flag("--resume", options.resume,
                 "Go on with the film in -o FILE.exr up to --spp samples in all; a new one where there is no such file "
                 "(default: off)");
}

void addCameraOptions(CLI::App& app, Options& options) {
    app.option_defaults()->group("Camera (in the coordinates of the input scan)");
    CameraRequest& camera = options.render.camera;
    add(app, "--view", "NAME", "A view of the scene file, in place of its camera; the options below overrule it",
        [&](const std::string& text) { options.view = text; });
    add(app, "--eye", "X,Y,Z", "Where it stands (default: +Z of the scene, far enough to see all of it)",
        [&](const std::string& text) { camera.eye = parseVector(text); });
    add(app, "--target", "X,Y,Z", "What it looks at (default: the centre of the scene)",
        [&](const std::string& text) { camera.target = parseVector(text); });
    add(app, "--up", "X,Y,Z", "What is up in the image (default 0,1,0)",
        [&](const std::string& text) { camera.up = parseVector(text); });
    char fov[16];
    std::snprintf(fov, sizeof fov, "%g", camera.fov_deg);
    add(app, "--fov", "DEG", std::string("Vertical field of view (default ") + fov + ", above 0 and below 180)",
        [&](const std::string& text) { options.choices.fov_deg = parseAngle(text); });
    add(app, "--ortho", "HEIGHT|fit",
        "Parallel projection that shows this height of the scene, or with fit all of it (default: off; not with --fov)",
        [&](const std::string& text) {
            camera.ortho = true;
            if (text != "fit") camera.ortho_height = parseRealAbove(text, 0, kMaxHeight);
        });
}

void addSceneOptions(CLI::App& app, Options& options) {
    app.option_defaults()->group("Light and surfaces");
    RenderSettings& render = options.render;
    SceneChoices& choices = options.choices;
    add(app, "--integrator", "NAME", choiceText(kIntegratorNames, render.integrator),
        [&](const std::string& text) { options.choices.integrator = parseName(kIntegratorNames, text); });
    add(app, "--bounces", "N", "Secondary rays in a path at most" + rangeText(render.bounces, 0, kMaxBounces),
        [&](const std::string& text) { options.choices.bounces = parseCount(text, 0, kMaxBounces); });
    add(app, "--room", "NAME",
        "A box around the scene: none, mirror, matte (default: none; without --lights too, and without lights in the "
        "scene, a studio of three lamps over a floor)",
        [&](const std::string& text) { render.room = parseName(kRoomNames, text); });
    add(app, "--lights", "N",
        "Point lights on a ring above a scene that has no light of its own (default 3 with --room, 0 to " +
            std::to_string(kMaxLights) + ")",
        [&](const std::string& text) { render.lights = parseCount(text, 0, kMaxLights); });
    add(app, "--shadows", "on|off", "Shadow rays" + defaultText(nameOf(kSwitchNames, render.shadows)),
        [&](const std::string& text) { choices.shadows = parseName(kSwitchNames, text); });
    add(app, "--blend", "on|off", "Blend overlapping splats" + defaultText(nameOf(kSwitchNames, render.blend)),
        [&](const std::string& text) { choices.blend = parseName(kSwitchNames, text); });
    add(app, "--caustics", "on|off",
        "Light bundled by glass and mirrors" + defaultText(nameOf(kSwitchNames, render.caustics)),
        [&](const std::string& text) { choices.caustics = parseName(kSwitchNames, text); });
    add(app, "--reflectivity", "R", "Of every surface, 0 matte to 1 mirror (default: each material's own)",
        [&](const std::string& text) { render.reflectivity = static_cast<float>(parseReal(text, 0, 1)); });
}

void addWindowOptions(CLI::App& app, Options& options) {
    app.option_defaults()->group("Window (without -o and --bench; H in it lists keys)");
    add(app, "--record", "FILE", "Write what you do in the window to FILE (default: none)",
        [&](const std::string& text) { options.record = text; });
    add(app, "--replay", "FILE", "Do what FILE says, then quit; its screenshots become NAME.png (default: none)",
        [&](const std::string& text) { options.replay = text; });
    app.add_flag("--offscreen", options.offscreen,
                 "Replay without showing a window or needing a display (default: off)");
}

void addRunOptions(CLI::App& app, Options& options) {
    app.option_defaults()->group("Run");
    add(app, "--device", "list|N|NAME", "Vulkan device by number or part of its name; list shows them (default: best)",
        [&](const std::string& text) {
            options.list_devices = text == "list";
            options.device = options.list_devices ? "" : text;
        });
    add(app, "--bench", "N",
        "Render N frames after a warm-up, print JSON (default: none, 1 to " + std::to_string(kMaxBenchFrames) + ")",
        [&](const std::string& text) { options.bench_frames = parseCount(text, 1, kMaxBenchFrames); });
    add(app, "--stats", "FILE", "Write counts and times as JSON, - for standard output (default: none)",
        [&](const std::string& text) { options.stats = text; });
    add(app, "--progress", "auto|lines",
        "On standard error; lines: 'progress SHARE DETAIL' for programs (default auto: for people)",
        [&](const std::string& text) { options.progress_lines = parseName(kProgressNames, text); });
    app.add_flag("-q,--quiet", options.quiet, "No progress (default: off)");
    app.add_flag("-v,--verbose", options.verbose, "More detail on standard error (default: off)");
    app.set_version_flag("--version", "pointrt-view " POINTRT_VERSION, "Print the version and end");
    app.set_help_flag("-h,--help", "Print this help and end");
}

void requireOutput(const Options& options, bool given, const char* option, const char* suffix) {
    if (given && !options.output.ends_with(suffix))
        throw Error{ExitCode::kBadUsage, std::string(option) + ": goes with -o FILE" + suffix};
}

void requireWindow(const Options& options) {
    const char* option = !options.record.empty() ? "--record" : !options.replay.empty() ? "--replay" : "--offscreen";
    const bool any = !options.record.empty() || !options.replay.empty() || options.offscreen;
    if (any && !opensWindow(options))
        throw Error{ExitCode::kBadUsage, std::string(option) + " is for the window: leave out -o and --bench"};
    if (options.offscreen && options.replay.empty())
        throw Error{ExitCode::kBadUsage, "--offscreen needs --replay FILE: nobody could close such a window"};
    if (!options.record.empty() && options.record == options.replay)
        throw Error{ExitCode::kBadUsage, "--record and --replay name the same file"};
    if (opensWindow(options) && (options.limits.seconds || options.limits.noise))
        throw Error{ExitCode::kBadUsage, "--time-limit and --noise go with -o FILE; the window refines until --spp"};
}

void requireTask(const Options& options) {
    if (options.quiet && options.verbose) throw Error{ExitCode::kBadUsage, "-q and -v exclude each other"};
    if (options.choices.fov_deg && options.render.camera.ortho)
        throw Error{ExitCode::kBadUsage,
                    "--fov and --ortho exclude each other: a parallel projection has no field of view"};
    if (options.list_devices) return;
    requireOutput(options, options.resume, "--resume", ".exr");
    if (!opensWindow(options)) requireOutput(options, options.choices.exposure.has_value(), "--exposure", ".png");
    if (options.resume && options.bench_frames != 0)
        throw Error{ExitCode::kBadUsage, "--resume and --bench exclude each other"};
    if (options.turntable != 0 && (options.resume || options.bench_frames != 0))
        throw Error{ExitCode::kBadUsage, std::string("--turntable and ") + (options.resume ? "--resume" : "--bench") +
                                             " exclude each other"};
    if (options.scene.empty()) throw Error{ExitCode::kBadUsage, "no scene given; --help lists the options"};
    requireFrameNames(options.output, options.turntable != 0);
    requireWindow(options);
}

} // namespace

bool opensWindow(const Options& options) {
    return !options.list_devices && options.output.empty() && options.bench_frames == 0;
}

std::optional<int> parseOptions(int argc, const char* const* argv, Options& options) {
    CLI::App app("Renders point scans and scenes of them by tracing rays on a Vulkan device.", "pointrt-view");
    app.get_formatter()->column_width(26);
    app.footer(
        "Exit codes: 0 done, 1 the scene is wrong, 2 wrong usage, 3 this machine cannot, 4 cannot write.\n"
        "Ctrl-C while FILE.exr is rendered: the sample under way is finished and the film saved, for --resume; the "
        "exit\n"
        "status is the signal's all the same. A second Ctrl-C ends at once.\n"
        "POINTRT_VALIDATION=1 in the environment turns the Vulkan validation layer on; any message is exit code 3.");
    app.option_defaults()->multi_option_policy(CLI::MultiOptionPolicy::TakeLast);
    app.add_option(
           "SCENE", options.scene,
           "FILE.pro as pointrt-bake wrote it, or a scene file FILE.toml (docs/SCENES.md), which the options overrule")
        ->type_name("")
        ->group("Scene");
    addImageOptions(app, options);
    addQualityOptions(app, options);
    addCameraOptions(app, options);
    addSceneOptions(app, options);
    addWindowOptions(app, options);
    addRunOptions(app, options);
    try {
        app.parse(argc, argv);
    } catch (const CLI::CallForHelp&) {
        std::fputs(app.help().c_str(), stdout);
        return 0;
    } catch (const CLI::CallForVersion& version) {
        std::puts(version.what());
        return 0;
    } catch (const CLI::ParseError& error) {
        throw Error{ExitCode::kBadUsage, error.what()};
    }
    requireTask(options);
    return {};
}

} // namespace pointrt

// SPDX-License-Identifier: Apache-2.0
#include "runtime/options.h"

#include <CLI/CLI.hpp>

#include <charconv>
#include <cmath>
#include <cstdio>
#include <limits>
#include <stdexcept>
#include <utility>
#include <vector>

#include "pointrt/tool.hpp"

namespace pointrt {
namespace {

constexpr std::uint32_t kMaxSize = 16384; // pixels: what image viewers and GPUs take as a texture
constexpr std::uint32_t kMaxBounces = 64;
constexpr std::uint32_t kMaxLights = 16;
constexpr std::uint32_t kMaxSpp = 65536;
constexpr std::uint32_t kMaxBenchFrames = 100000;

template <typename Value>
using Names = std::vector<std::pair<const char*, Value>>;

const Names<Integrator> kIntegrators = {{"phong", Integrator::kPhong},
                                        {"whitted", Integrator::kWhitted},
                                        {"path", Integrator::kPath},
                                        {"normal", Integrator::kNormal},
                                        {"depth", Integrator::kDepth}};
const Names<Room> kRooms = {{"none", Room::kNone}, {"mirror", Room::kMirror}, {"matte", Room::kMatte}};
const Names<bool> kSwitch = {{"on", true}, {"off", false}};

/// All of text as a number; false where it is not one or out of T's range.
template <typename T>
bool parseNumber(const std::string& text, T& value) {
    const char* end = text.data() + text.size();
    const auto [rest, error] = std::from_chars(text.data(), end, value);
    return error == std::errc() && rest == end;
}

template <typename Value>
Value parseName(const Names<Value>& names, const std::string& text) {
    std::string known;
    for (const auto& [name, value] : names) {
        if (text == name) return value;
        known += (known.empty() ? "" : ", ") + std::string(name);
    }
    throw std::invalid_argument("\"" + text + "\" is none of " + known);
}

template <typename Value>
const char* nameOf(const Names<Value>& names, Value wanted) {
    for (const auto& [name, value] : names)
        if (value == wanted) return name;
    return "";
}

std::uint32_t parseCount(const std::string& text, std::uint32_t low, std::uint32_t high) {
    std::uint32_t value = 0;
    if (parseNumber(text, value) && value >= low && value <= high) return value;
    throw std::invalid_argument("\"" + text + "\" is not a whole number from " + std::to_string(low) + " to " +
                                std::to_string(high));
}

std::pair<std::uint32_t, std::uint32_t> parseSize(const std::string& text) {
    const std::size_t cross = text.find('x');
    std::uint32_t width = 0, height = 0;
    if (cross != std::string::npos && parseNumber(text.substr(0, cross), width) &&
        parseNumber(text.substr(cross + 1), height) && width >= 1 && height >= 1 && width <= kMaxSize &&
        height <= kMaxSize)
        return {width, height};
    throw std::invalid_argument("\"" + text + "\" is not WxH with 1 to " + std::to_string(kMaxSize) + " pixels each");
}

double parseAngle(const std::string& text) {
    double value = 0;
    if (parseNumber(text, value) && value > 0 && value < 180) return value;
    throw std::invalid_argument("\"" + text + "\" is not an angle above 0 and below 180 degrees");
}

float parseShare(const std::string& text) {
    float value = 0;
    if (parseNumber(text, value) && value >= 0 && value <= 1) return value;
    throw std::invalid_argument("\"" + text + "\" is not a number from 0 to 1");
}

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
    add(app, "-o,--output", "FILE", "Render to FILE.png (8-bit sRGB) or FILE.exr (float, with first hits)",
        [&](const std::string& text) {
            options.output = parseOutput(text);
            options.render.first_hits = text.ends_with(".exr");
        });
    add(app, "--size", "WxH",
        "Image size in pixels (default " + std::to_string(render.width) + "x" + std::to_string(render.height) +
            ", each 1 to " + std::to_string(kMaxSize) + ")",
        [&](const std::string& text) { std::tie(render.width, render.height) = parseSize(text); });
    add(app, "--spp", "N", "Samples a pixel; 1 samples its centre" + rangeText(render.spp, 1, kMaxSpp),
        [&](const std::string& text) { render.spp = parseCount(text, 1, kMaxSpp); });
    const std::uint32_t max_seed = std::numeric_limits<std::uint32_t>::max();
    add(app, "--seed", "N", "Of the random numbers" + rangeText(render.seed, 0, max_seed),
        [&render, max_seed](const std::string& text) { render.seed = parseCount(text, 0, max_seed); });
}

void addCameraOptions(CLI::App& app, Options& options) {
    app.option_defaults()->group("Camera (in the coordinates of the input scan)");
    CameraRequest& camera = options.render.camera;
    add(app, "--eye", "X,Y,Z", "Where it stands (default: +Z of the scene, far enough to see all of it)",
        [&](const std::string& text) { camera.eye = parseVector(text); });
    add(app, "--target", "X,Y,Z", "What it looks at (default: the centre of the scene)",
        [&](const std::string& text) { camera.target = parseVector(text); });
    add(app, "--up", "X,Y,Z", "What is up in the image (default 0,1,0)",
        [&](const std::string& text) { camera.up = parseVector(text); });
    char fov[16];
    std::snprintf(fov, sizeof fov, "%g", camera.fov_deg);
    add(app, "--fov", "DEG", std::string("Vertical field of view (default ") + fov + ", above 0 and below 180)",
        [&](const std::string& text) { camera.fov_deg = parseAngle(text); });
}

void addSceneOptions(CLI::App& app, Options& options) {
    app.option_defaults()->group("Light and surfaces");
    RenderSettings& render = options.render;
    add(app, "--integrator", "NAME", choiceText(kIntegrators, render.integrator),
        [&](const std::string& text) { render.integrator = parseName(kIntegrators, text); });
    add(app, "--bounces", "N", "Secondary rays in a path at most" + rangeText(render.bounces, 0, kMaxBounces),
        [&](const std::string& text) { render.bounces = parseCount(text, 0, kMaxBounces); });
    add(app, "--room", "NAME",
        "A box around the scene: none, mirror, matte (default: none; without --lights too, and without lights in the "
        "scene, a studio of three lamps over a floor)",
        [&](const std::string& text) { render.room = parseName(kRooms, text); });
    add(app, "--lights", "N",
        "Point lights on a ring above the scene (default 3 with --room, 0 to " + std::to_string(kMaxLights) + ")",
        [&](const std::string& text) { render.lights = parseCount(text, 0, kMaxLights); });
    add(app, "--shadows", "on|off", "Shadow rays" + defaultText(nameOf(kSwitch, render.shadows)),
        [&](const std::string& text) { render.shadows = parseName(kSwitch, text); });
    add(app, "--blend", "on|off", "Blend overlapping splats" + defaultText(nameOf(kSwitch, render.blend)),
        [&](const std::string& text) { render.blend = parseName(kSwitch, text); });
    add(app, "--reflectivity", "R", "Of every surface, 0 matte to 1 mirror (default: each material's own)",
        [&](const std::string& text) { render.reflectivity = parseShare(text); });
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
    app.add_flag("-q,--quiet", options.quiet, "No progress (default: off)");
    app.add_flag("-v,--verbose", options.verbose, "More detail on standard error (default: off)");
    app.set_version_flag("--version", "pointrt-view " POINTRT_VERSION, "Print the version and end");
    app.set_help_flag("-h,--help", "Print this help and end");
}

void requireTask(const Options& options) {
    if (options.quiet && options.verbose) throw Error{ExitCode::kBadUsage, "-q and -v exclude each other"};
    if (options.list_devices) return;
    if (options.scene.empty()) throw Error{ExitCode::kBadUsage, "no scene given; --help lists the options"};
    if (options.output.empty() && options.bench_frames == 0)
        throw Error{ExitCode::kBadUsage, "this build has no window yet; -o FILE.png or -o FILE.exr renders to a file"};
}

} // namespace

Vec3 parseVector(const std::string& text) {
    double values[3] = {};
    std::size_t start = 0;
    for (int i = 0; i < 3; ++i) {
        const std::size_t comma = text.find(',', start);
        const bool last = comma == std::string::npos;
        if (last != (i == 2) || !parseNumber(text.substr(start, comma - start), values[i]) || !std::isfinite(values[i]))
            throw std::invalid_argument("\"" + text + "\" is not X,Y,Z with three finite numbers");
        start = comma + 1;
    }
    return {values[0], values[1], values[2]};
}

std::optional<int> parseOptions(int argc, const char* const* argv, Options& options) {
    CLI::App app("Renders a .pro scene by tracing rays on a Vulkan device.", "pointrt-view");
    app.get_formatter()->column_width(26);
    app.footer(
        "Exit codes: 0 done, 1 the scene is wrong, 2 wrong usage, 3 this machine cannot, 4 cannot write.\n"
        "POINTRT_VALIDATION=1 in the environment turns the Vulkan validation layer on; any message is exit code 3.");
    app.option_defaults()->multi_option_policy(CLI::MultiOptionPolicy::TakeLast);
    app.add_option("SCENE", options.scene, "The scene, FILE.pro")->type_name("")->group("Scene");
    addImageOptions(app, options);
    addCameraOptions(app, options);
    addSceneOptions(app, options);
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

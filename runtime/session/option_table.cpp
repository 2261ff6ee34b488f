// SPDX-License-Identifier: Apache-2.0
#include "runtime/session/option_table.h"

#include <algorithm>
#include <array>
#include <stdexcept>

#include "runtime/scene/camera.h"
#include "runtime/scene/turntable.h"
#include "runtime/scene/upright.h"
#include "runtime/util/parse.h"

namespace pointrt {
namespace {

constexpr std::uint32_t kMaxBenchFrames = 100000;
constexpr std::uint32_t kMaxThumbnail = 1024; // the largest of file managers
constexpr double kMaxSeconds = 1e7;           // a third of a year
constexpr double kMaxHeight = 1e12;           // as scene files take lengths

constexpr std::array kProgressNames = {Name{"auto", false}, Name{"lines", true}};

constexpr std::array kDistortionNames = {Name{"refuse", false}, Name{"drop", true}};
constexpr double kMaxDepthUnit = 1e9;

/// A layer for cameras' pictures, and where options have it.
struct LayerName {
    const char* name;
    bool CameraOutput::*member;
};
constexpr std::array kLayerNames = {
    LayerName{"rgb", &CameraOutput::rgb},           LayerName{"albedo", &CameraOutput::albedo},
    LayerName{"depth", &CameraOutput::depth},       LayerName{"normal", &CameraOutput::normal},
    LayerName{"instance", &CameraOutput::instance}, LayerName{"exr", &CameraOutput::exr}};

void setLayers(CameraOutput& output, const std::string& text) {
    for (const LayerName& each : kLayerNames) output.*each.member = false;
    for (std::size_t begin = 0; begin <= text.size();) {
        const std::size_t end = std::min(text.find(',', begin), text.size());
        const std::string word = text.substr(begin, end - begin);
        const auto layer = std::find_if(kLayerNames.begin(), kLayerNames.end(),
                                        [&](const LayerName& each) { return each.name == word; });
        if (layer == kLayerNames.end())
            throw std::invalid_argument("\"" + word + "\" is none of " + joinedNames(kLayerNames, ", "));
        output.*layer->member = true;
        begin = end + 1;
    }
}

Vec3 parseUp(const std::string& text) {
    try {
        return parseVector(text);
    } catch (const std::invalid_argument&) {
        throw std::invalid_argument("\"" + text +
                                    "\" is none of auto, x, y, z, -x, -y, -z, and not X,Y,Z with three finite numbers");
    }
}

void setOrtho(CameraRequest& camera, const std::string& text) {
    camera.ortho = true;
    if (text != "fit") camera.ortho_height = parseRealAbove(text, 0, kMaxHeight);
}

void setUp(Options& options, const std::string& text) {
    options.up_axis = axisNamed(text);
    options.camera.up.reset();
    options.camera.side = CameraRequest{}.side;
    if (text == "auto") return;
    options.camera.up = options.up_axis ? *options.up_axis : parseUp(text);
    if (options.up_axis) options.camera.side = frontSide(*options.up_axis);
}

void setDevice(Options& options, const std::string& text) {
    options.list_devices = text == "list";
    options.device = options.list_devices ? "" : text;
}

OptionGroup imageOptions() {
    return {
        "Image",
        {{"-o,--output", "FILE",
          "Render to FILE.png (8-bit sRGB) or FILE.exr (float, with first hits and the parts of the light), replacing "
          "what is there; - is PNG to standard output",
          [](Options& o, const std::string& text) { o.output = text; }, ".png .exr"},
         {"--turntable", "N",
          "Render N pictures with the camera going around the target once, -o frames/%04d.png (default: none, 1 "
          "to " +
              std::to_string(kMaxTurntable) + ")",
          [](Options& o, const std::string& text) { o.turntable = parseCount(text, 1, kMaxTurntable); }},
         {"--thumbnail", "N",
          "Render a PNG of N x N pixels to -o FILE, whatever its suffix, in about a second, for file managers "
          "(default: "
          "none, 1 to " +
              std::to_string(kMaxThumbnail) + ")",
          [](Options& o, const std::string& text) { o.thumbnail = parseCount(text, 1, kMaxThumbnail); }}},
        HelpGroup::kImage};
}

/// With one of the first two --spp is the most, and what a scene file says of samples is not asked.
OptionGroup qualityOptions() {
    return {
        "How long",
        {{"--time-limit", "SECONDS",
          "Samples until the time is up; what has none a second later stays black (default: none; with it --spp is the "
          "most, and without --spp " +
              std::to_string(kMaxSpp) + " are)",
          [](Options& o, const std::string& text) { o.limits.seconds = parseRealAbove(text, 0, kMaxSeconds); }},
         {"--noise", "TARGET",
          "Samples until the relative noise of the picture is this or less, such as 0.02 (default: none; --spp as "
          "above)",
          [](Options& o, const std::string& text) { o.limits.noise = parseRealAbove(text, 0, 1); }},
         {.names = "--resume",
          .help = "Go on with the film in -o FILE.exr up to --spp samples in all; a new one where there is no such "
                  "file (default: off)",
          .flag = &Options::resume}},
        {}};
}

OptionGroup cameraOptions() {
    return {
        "Camera (in the coordinates of the input scan)",
        {{"--view", "NAME",
          "A view of the scene file in place of its camera, or of any scene " + joinedNames(kStandardViewNames, ", ") +
              "; the options below overrule it",
          [](Options& o, const std::string& text) { o.view = text; }, joinedNames(kStandardViewNames, " ")},
         {"--eye", "X,Y,Z",
          "Where it stands (default: at the side that shows most, as near as all of the scene but strays fits; where "
          "one scanner saw all, there)",
          [](Options& o, const std::string& text) { o.camera.eye = parseVector(text); }},
         {"--target", "X,Y,Z", "What it looks at (default: the centre of the scene)",
          [](Options& o, const std::string& text) { o.camera.target = parseVector(text); }},
         {"--up", "auto|AXIS|X,Y,Z",
          "What is up: x, y, z, -x, -y or -z stands the scene on it and looks at its front; a vector turns the "
          "image (default auto: as the scan says, else y)",
          setUp, "x y z -x -y -z"},
         {"--fov", "DEG",
          "Vertical field of view (default " + plainText(CameraRequest{}.fov_deg) + ", above 0 and below 180)",
          [](Options& o, const std::string& text) { o.fov_deg = parseAngle(text); }},
         {"--ortho", "HEIGHT|fit",
          "Parallel projection that shows this height of the scene, or with fit all of it (default: off; not with "
          "--fov)",
          [](Options& o, const std::string& text) { setOrtho(o.camera, text); }}},
        {}};
}

OptionGroup camerasOptions() {
    return {
        "Pictures for machines (from a list of cameras, in the coordinates of the input scan)",
        {{"--cameras", "FILE|FOLDER",
          "Render a picture from each camera of a transforms.json (nerfstudio, Instant-NGP), or of COLMAP's cameras "
          "and images (.txt, .bin), to -o FOLDER, with a transforms.json that names them (default: none)",
          [](Options& o, const std::string& text) { o.cameras = text; }, ".json .txt .bin"},
         {"--layers", "NAMES",
          "What is written of each, apart by commas: " + joinedNames(kLayerNames, ", ") +
              "; depths are whole numbers along the viewing axis, 0 for nothing (default rgb,depth,normal,exr)",
          [](Options& o, const std::string& text) { setLayers(o.camera_output, text); }, joinedNames(kLayerNames, " ")},
         {"--depth-unit", "LENGTH",
          "A depth PNG's 1, in the scan's unit (default: 0.001, or the next power of ten that all of the scene "
          "fits in 65535 of)",
          [](Options& o, const std::string& text) {
              o.camera_output.depth_unit = parseRealAbove(text, 0, kMaxDepthUnit);
          }},
         {"--distortion", "refuse|drop",
          "Lists whose lenses are distorted: none is rendered, or all as if they were not (default refuse)",
          [](Options& o, const std::string& text) { o.drops_distortion = parseName(kDistortionNames, text); }}},
        {}};
}

OptionGroup windowOptions() {
    return {"Window (without -o and --bench; H in it lists keys)",
            {{"--record", "FILE", "Write what you do in the window to FILE (default: none)",
              [](Options& o, const std::string& text) { o.record = text; }},
             {"--replay", "FILE", "Do what FILE says, then quit; its screenshots become NAME.png (default: none)",
              [](Options& o, const std::string& text) { o.replay = text; }},
             {.names = "--offscreen",
              .help = "Replay without showing a window or needing a display (default: off)",
              .flag = &Options::offscreen}},
            {}};
}

OptionGroup runOptions() {
    return {
        "Run",
        {{"--device", "list|N|NAME", "Vulkan device by number or part of its name; list shows them (default: best)",
          setDevice},
         {"--memory", "SIZE",
          "What a picture of tile sets may take, such as 2G or 500M; where it wants more, tiles are coarser (default "
          "2G)",
          [](Options& o, const std::string& text) { o.memory = parseBytes(text); }},
         {"--bench", "N",
          "Render N frames after a warm-up, print JSON (default: none, 1 to " + std::to_string(kMaxBenchFrames) + ")",
          [](Options& o, const std::string& text) { o.bench_frames = parseCount(text, 1, kMaxBenchFrames); }},
         {"--stats", "FILE", "Write counts and times as JSON, - for standard output (default: none)",
          [](Options& o, const std::string& text) { o.stats = text; }, ".json"},
         {.names = "--profile",
          .help = "Where the time of a frame goes, pass by pass: on standard error, and in --stats and --bench as "
                  "\"profile\". Each pass waits for the one before: frames take a little longer (default: off)",
          .flag = &Options::profile},
         {"--progress", "auto|lines",
          "On standard error; lines: 'progress SHARE DETAIL' for programs (default auto: for people)",
          [](Options& o, const std::string& text) { o.progress_lines = parseName(kProgressNames, text); }},
         {.names = "-q,--quiet",
          .help = "No progress, but what --progress lines asks for; only errors (default: off)",
          .flag = &Options::quiet},
         {.names = "-v,--verbose", .help = "More detail on standard error (default: off)", .flag = &Options::verbose}},
        {}};
}

} // namespace

std::vector<OptionGroup> optionGroups() {
    return {
        imageOptions(),   qualityOptions(), cameraOptions(), {"Light and surfaces", {}, HelpGroup::kLightAndSurfaces},
        camerasOptions(), windowOptions(),  runOptions()};
}

} // namespace pointrt

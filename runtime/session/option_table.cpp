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
constexpr std::uint32_t kMaxThumbnail = 1024; // the largest size that file managers request
constexpr std::uint32_t kMaxFps = 240;        // for the fastest screens
constexpr double kMaxSeconds = 1e7;           // 116 days
constexpr double kMaxHeight = 1e12;           // the limit of lengths in scene files

constexpr std::array kProgressNames = {Name{"auto", false}, Name{"lines", true}};

constexpr std::array kDistortionNames = {Name{"refuse", false}, Name{"drop", true}};
constexpr double kMaxDepthUnit = 1e9;
constexpr double kMaxEyesApart = 1e6; // metres: a planet as a toy

/// A layer of --cameras, and the flag that selects it.
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
            throw std::invalid_argument("\"" + word + "\" is not one of " + joinedNames(kLayerNames, ", "));
        output.*layer->member = true;
        begin = end + 1;
    }
}

Vec3 parseUp(const std::string& text) {
    try {
        return parseVector(text);
    } catch (const std::invalid_argument&) {
        throw std::invalid_argument(
            "\"" + text + "\" is not one of auto, x, y, z, -x, -y, -z, and not X,Y,Z with three finite numbers");
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

void setMoving(Options& options, const std::string& text, bool follows_views) {
    if (options.turntable != 0 && options.follows_views != follows_views)
        throw std::invalid_argument("--turntable and --path cannot be combined");
    options.turntable = parseCount(text, 1, kMaxTurntable);
    options.follows_views = follows_views;
}

OptionGroup imageOptions() {
    return {
        "Image",
        {{"-o,--output", "FILE",
          "Render to FILE.png or FILE.tif (8-bit sRGB) or FILE.exr (float, with first hits and light components), "
          "overwriting an existing file; - writes a PNG to standard output; for moving cameras see --turntable",
          [](Options& o, const std::string& text) { o.output = text; }, ".png .tif .exr"},
         {"--turntable", "N",
          "Move the camera once around the target and render N pictures: -o frames/%04d.png writes PNGs, -o FILE.mp4 "
          "or FILE.webm a video, which needs ffmpeg (default: off; 1 to " +
              std::to_string(kMaxTurntable) + ")",
          [](Options& o, const std::string& text) { setMoving(o, text, false); }},
         {"--path", "N",
          "Move the camera smoothly from the first view of the scene file through the others to the last and render N "
          "pictures; -o as for --turntable (default: off; 1 to " +
              std::to_string(kMaxTurntable) + ")",
          [](Options& o, const std::string& text) { setMoving(o, text, true); }},
         {"--fps", "N",
          "Frame rate of a video, in pictures per second (default 25; 1 to " + std::to_string(kMaxFps) + ")",
          [](Options& o, const std::string& text) { o.fps = parseCount(text, 1, kMaxFps); }},
         {"--thumbnail", "N",
          "Render a PNG of N x N pixels in about a second, for file managers; -o FILE may have any suffix (default: "
          "off; 1 to " +
              std::to_string(kMaxThumbnail) + ")",
          [](Options& o, const std::string& text) { o.thumbnail = parseCount(text, 1, kMaxThumbnail); }}},
        HelpGroup::kImage};
}

/// --time-limit and --noise make --spp an upper bound and ignore the scene file's number of samples.
OptionGroup qualityOptions() {
    return {"Quality and time",
            {{"--time-limit", "SECONDS",
              "Keep sampling for SECONDS, up to --spp samples per pixel, or " + std::to_string(kMaxSpp) +
                  " without --spp; pixels not reached within another second stay black (default: no limit)",
              [](Options& o, const std::string& text) { o.limits.seconds = parseRealAbove(text, 0, kMaxSeconds); }},
             {"--noise", "TARGET",
              "Keep sampling until the relative noise of the picture is at most TARGET, e.g. 0.02; --spp limits it as "
              "with --time-limit (default: no target)",
              [](Options& o, const std::string& text) { o.limits.noise = parseRealAbove(text, 0, 1); }},
             {.names = "--resume",
              .help = "Add samples to an existing -o FILE.exr, up to --spp in all; create the file if there is none "
                      "(default: off)",
              .flag = &Options::resume}},
            {}};
}

OptionGroup cameraOptions() {
    return {
        "Camera (in the coordinates of the scan)",
        {{"--view", "NAME",
          "Start from a named view of the scene file or a standard view: " + joinedNames(kStandardViewNames, ", ") +
              "; the options below override it (default: the scene file's camera)",
          [](Options& o, const std::string& text) { o.view = text; }, joinedNames(kStandardViewNames, " ")},
         {"--eye", "X,Y,Z", "Camera position (default: framed automatically; at the scanner if there was only one)",
          [](Options& o, const std::string& text) { o.camera.eye = parseVector(text); }},
         {"--target", "X,Y,Z", "Point to look at (default: the centre of the scene)",
          [](Options& o, const std::string& text) { o.camera.target = parseVector(text); }},
         {"--up", "auto|AXIS|X,Y,Z",
          "Up direction. An axis (x, y, z, -x, -y, -z) turns the whole scene upright and selects its front; a vector "
          "rotates the picture only (default auto: the scan's up, else y)",
          setUp, "x y z -x -y -z"},
         {"--fov", "DEG",
          "Vertical field of view in degrees (default " + plainText(CameraRequest{}.fov_deg) +
              "; above 0 and below 180)",
          [](Options& o, const std::string& text) { o.fov_deg = parseAngle(text); }},
         {"--ortho", "HEIGHT|fit",
          "Use a parallel projection in which the picture is HEIGHT scene units high; fit shows the whole scene "
          "(default: off; not with --fov)",
          [](Options& o, const std::string& text) { setOrtho(o.camera, text); }},
         {.names = "--panorama",
          .help = "Render a level, equirectangular 360-degree panorama, twice as wide as high, from --eye, else from "
                  "the scanner's position, else from the middle of the room. The default --size is then 2048x1024. "
                  "PNGs get the metadata by which panorama viewers recognise them (default: off)",
          .flag = &Options::panorama},
         {"--stereo", "METRES",
          "With --panorama: render a square picture for stereo viewing, with the left eye's panorama above the right "
          "eye's; METRES is the distance between the eyes, e.g. 0.063 (default: off)",
          [](Options& o, const std::string& text) { o.camera.eyes_apart_m = parseRealAbove(text, 0, kMaxEyesApart); }},
         {"--plan", "SIZE",
          "Render a plan to scale: the scan seen from above, at SIZE scene units per pixel. It shows the whole scan, "
          "or --size pixels around --target. FILE.png gets a world file FILE.pgw; FILE.tif is a GeoTIFF. Pixels "
          "without a surface are transparent unless --background is given (default: off)",
          [](Options& o, const std::string& text) { o.plan = parseRealAbove(text, 0, kMaxHeight); }}},
        {}};
}

OptionGroup clipOptions() {
    return {
        "Clips and sections (in the coordinates of the scan)",
        {{"--clip",
          "MINX,MINY,MINZ,MAXX,MAXY,MAXZ",
          "Show only the parts of scans and Gaussian captures inside this box; what is outside casts no shadow either. "
          "Shapes, lights and rooms are not clipped. Several boxes: show what is inside all of them. For planes and "
          "rotated boxes see [[clip]] of scene files (default: no clipping)",
          [](Options& o, const std::string& text) { o.clips.push_back(clipBox(parseBox(text))); },
          {},
          nullptr,
          true},
         {"--only",
          "NAME=VALUES",
          "Show only points whose attribute has one of these values, e.g. class=2,6, or lies in this range, e.g. "
          "height=10:25; hidden points cast no shadow either. NAME is as for --color-by. Several filters: show points "
          "that match all of them. Scans without the attribute are shown in full (default: no filter)",
          [](Options& o, const std::string& text) { o.filters.push_back(parseFilter(text)); },
          {},
          nullptr,
          true},
         {"--hide",
          "NAME",
          "Hide a scan, shape, light or clip, given by its name in the scene file, by the file name of a scan, or by "
          "its number, as in 'light 2' (default: only those with visible = false in the scene file)",
          [](Options& o, const std::string& text) { o.hidden.push_back(text); },
          {},
          nullptr,
          true},
         {"--section", "PLANE",
          "Cut the scan along a plane and show the cut in parallel projection. If z is up, z=1.2 shows what is below "
          "that height, as in a floor plan; x=3 and y=3 are vertical sections, with the other coordinate increasing to "
          "the right; -y=3 shows the other half, seen from the other side. X0,Y0,X1,Y1 is a vertical section through "
          "two points, the first one on the left. A thickness keeps a slice only: y=3:0.5 keeps 0.25 on each side of "
          "the plane. --eye, --target and --view then change the camera, not the cut (default: off)",
          [](Options& o, const std::string& text) { o.section = parseSection(text); }}},
        {}};
}

OptionGroup camerasOptions() {
    return {
        "Batch rendering (cameras in the coordinates of the scan)",
        {{"--cameras", "FILE|FOLDER",
          "Render from each camera of a transforms.json (nerfstudio, Instant-NGP) or of a COLMAP model (cameras and "
          "images, .txt or .bin); write the pictures and a transforms.json to -o FOLDER (default: off)",
          [](Options& o, const std::string& text) { o.cameras = text; }, ".json .txt .bin"},
         {"--layers", "NAMES",
          "Layers to write for each camera, separated by commas: " + joinedNames(kLayerNames, ", ") +
              "; depth is a 16-bit PNG of distances along the viewing axis, 0 for no hit (default "
              "rgb,depth,normal,exr)",
          [](Options& o, const std::string& text) { setLayers(o.camera_output, text); }, joinedNames(kLayerNames, " ")},
         {"--depth-unit", "LENGTH",
          "Scene units per depth PNG step (default: 0.001, or the smallest larger power of ten at which the scene's "
          "depth fits in 16 bits)",
          [](Options& o, const std::string& text) {
              o.camera_output.depth_unit = parseRealAbove(text, 0, kMaxDepthUnit);
          }},
         {"--distortion", "refuse|drop",
          "What to do if cameras have lens distortion: refuse the list, or drop the distortion and render pinhole "
          "pictures (default refuse)",
          [](Options& o, const std::string& text) { o.drops_distortion = parseName(kDistortionNames, text); }}},
        {}};
}

OptionGroup lightOptions() {
    return {"Light and surfaces",
            {{"--sun", "TIME[@LAT,LON]",
              "Light the scene with the sun and sky of a local time, e.g. 2026-06-21T15:00, or with its UTC offset "
              "2026-06-21T15:00-07:00, at a latitude and longitude in degrees (default: those of the scan, if its file "
              "names a coordinate system)",
              [](Options& o, const std::string& text) { o.sun = parseSun(text); }}},
            HelpGroup::kLightAndSurfaces};
}

OptionGroup windowOptions() {
    return {"Window (without -o and --bench; press H in it for the keys)",
            {{"--record", "FILE", "Record your actions in the window to FILE (default: off)",
              [](Options& o, const std::string& text) { o.record = text; }},
             {"--replay", "FILE", "Replay a recording, then quit; its screenshots are saved as NAME.png (default: off)",
              [](Options& o, const std::string& text) { o.replay = text; }},
             {.names = "--offscreen",
              .help = "Replay without a visible window or a display (default: off)",
              .flag = &Options::offscreen}},
            {}};
}

OptionGroup runOptions() {
    return {
        "Run",
        {{"--device", "list|N|NAME",
          "Vulkan device to use, by number or part of its name; list prints all devices (default: a discrete GPU, else "
          "an "
          "integrated one, else a CPU driver)",
          setDevice},
         {"--rays", "walk|hardware|auto",
          "How rays find splats: walk through pointrt's tracing index, or hardware ray queries; auto uses hardware on "
          "GPUs that support it. Tile sets and Gaussians always use walk (default walk)",
          [](Options& o, const std::string& text) { o.traversal = parseName(kTraversalNames, text); }},
         {"--memory", "SIZE",
          "Memory limit for the tiles of tile sets, e.g. 2G or 500M; coarser tiles are used if the finest do not fit "
          "(default 2G)",
          [](Options& o, const std::string& text) { o.memory = parseBytes(text); }},
         {"--bench", "N",
          "Render N frames after a warm-up and print timings as JSON (default: off; 1 to " +
              std::to_string(kMaxBenchFrames) + ")",
          [](Options& o, const std::string& text) { o.bench_frames = parseCount(text, 1, kMaxBenchFrames); }},
         {"--stats", "FILE", "Write counts and timings as JSON to FILE, - for standard output (default: off)",
          [](Options& o, const std::string& text) { o.stats = text; }, ".json"},
         {.names = "--profile",
          .help = "Print the time of each pass to standard error, and add it to --stats and --bench as \"profile\". "
                  "Passes no longer overlap, so frames take slightly longer (default: off)",
          .flag = &Options::profile},
         {"--progress", "auto|lines",
          "Progress on standard error: auto redraws one line on a terminal, lines prints 'progress SHARE DETAIL' for "
          "programs to parse (default auto)",
          [](Options& o, const std::string& text) { o.progress_lines = parseName(kProgressNames, text); }},
         {"--bake", "OPTION...",
          "Pass all arguments after this one to pointrt-bake, which bakes the scans (see pointrt-bake --help)",
          [](Options&, const std::string&) {
              throw std::invalid_argument(
                  "write the options of pointrt-bake after it as separate arguments, without =");
          }},
         {.names = "-q,--quiet",
          .help = "Print only errors, and progress with --progress lines (default: off)",
          .flag = &Options::quiet},
         {.names = "-v,--verbose",
          .help = "Print more detail to standard error (default: off)",
          .flag = &Options::verbose}},
        {}};
}

} // namespace

std::vector<OptionGroup> optionGroups() {
    return {imageOptions(), qualityOptions(), cameraOptions(), clipOptions(),
            lightOptions(), camerasOptions(), windowOptions(), runOptions()};
}

} // namespace pointrt

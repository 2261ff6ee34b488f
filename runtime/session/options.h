// SPDX-License-Identifier: Apache-2.0
// The command line of pointrt-view.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "runtime/device_scene/cut.h"
#include "runtime/gpu/traversal.h"
#include "runtime/image/geo_reference.h"
#include "runtime/render/frame_limits.h"
#include "runtime/scene/clip.h"
#include "runtime/scene/filter.h"
#include "runtime/scene/render_settings.h"
#include "runtime/scene/section.h"
#include "runtime/session/sun_option.h"

namespace pointrt {

/// The layers written for each camera of a list.
struct CameraOutput {
    bool rgb = true, albedo = false, depth = true, normal = true, instance = false, exr = true;
    std::optional<double> depth_unit; ///< scene units per step; none: as small as the scene allows
    bool operator==(const CameraOutput&) const = default;
};

/// The command line; resolveSettings (settings.h) merges it with the scene file.
struct Options {
    std::vector<std::string> inputs;       ///< a scene, or scans to bake, as named on the command line
    std::vector<std::string> bake_options; ///< of pointrt-bake, for scans
    std::string scene;                     ///< the scene to open: the input, or the .pro baked from scans
    std::vector<std::string> added;        ///< further scans (.pro, .proset) to show together with scene
    std::string source;                    ///< the name by which users know scene, such as the scan it was baked
                                           ///< from; empty: scene itself
    std::string output; ///< FILE.png, FILE.tif, FILE.exr or "-", or a folder with cameras; empty with a window,
                        ///< bench_frames or list_devices
    std::string device; ///< a selector, see DeviceRequest
    Traversal traversal = Traversal::kWalk;
    std::string stats;                      ///< file for the report, "-" for standard output, empty for none
    RenderChoices choices;                  ///< the rows of render_setting_table.h
    CameraRequest camera;                   ///< without its fov_deg
    std::optional<Vec3> up_axis;            ///< the up axis given; also applies to the scene, unless that has its own
    std::optional<double> fov_deg;          ///< none: not given
    std::vector<ClipDescription> clips;     ///< boxes, besides the clips of the scene file
    std::vector<FilterDescription> filters; ///< besides those of the scene file
    std::vector<std::string> hidden;        ///< names of layers (layers.h)
    std::optional<SectionRequest> section;
    std::optional<SunOption> sun;
    FrameLimits limits;
    std::optional<std::uint64_t> memory; ///< bytes for the tiles of sets; none: kTileMemory
    std::string view;                    ///< name of a view, empty: the scene's camera
    std::string cameras;                 ///< a list of cameras, empty for none; output is then a folder
    CameraOutput camera_output;          ///< layers of each camera
    bool drops_distortion = false;       ///< ignore lens distortion in cameras
    std::uint32_t turntable = 0;       ///< pictures of a moving camera, 0: none; output is then a pattern (turntable.h)
    std::string video;                 ///< FILE.mp4 or FILE.webm to make of these pictures, empty: none
    std::uint32_t fps = 25;            ///< pictures per second of the video
    bool follows_views = false;        ///< the camera moves through the scene's views, not around the target
    std::uint32_t thumbnail = 0;       ///< side in pixels, 0: none; output is then a PNG with any suffix
    bool panorama = false;             ///< all around the eye; also in camera
    double plan = 0;                   ///< side of a plan's pixel in scene units, 0: no plan
    std::optional<GeoReference> place; ///< of a plan, set by fillPlan (plan_view.h)
    bool resume = false;               ///< continue the film in output, an .exr
    std::uint32_t bench_frames = 0;    ///< 0: no benchmark
    bool list_devices = false;
    bool profile = false; ///< needs output or bench_frames
    // without output and bench_frames a window opens
    std::string record, replay; ///< recordings of the window (window/input/recording.h), empty for none
    bool offscreen = false;     ///< replay without a visible window
    bool quiet = false, verbose = false;
    bool progress_lines = false; ///< machine-readable progress
};

/// True if output is an 8-bit picture: FILE.png, FILE.tif, a thumbnail, or "-" for a PNG on standard output.
bool writesToneMapped(const Options& options);

/// True if path is opened as it is: a scene file, a tile set or a .pro. Everything else is a scan to bake.
bool isScene(const std::string& path);

/// True if all paths are scans that are baked: files or sets that can be opened together.
bool areBakedScans(const std::vector<std::string>& paths);

/// The option that requests pictures of a moving camera: --path or --turntable.
const char* movingOption(bool follows_views);

/// True if path is a video's: FILE.mp4 or FILE.webm.
bool isVideo(const std::string& path);

/// True if options open a window.
bool opensWindow(const Options& options);

/// Fills options from the command line. Returns an exit code if the run ends here, after --help, --version or
/// --generate. Throws Error kBadUsage with a one-line message for mistakes.
std::optional<int> parseOptions(int argc, const char* const* argv, Options& options);

} // namespace pointrt

// SPDX-License-Identifier: Apache-2.0
// The command line of pointrt-view.
#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "runtime/device_scene/cut.h"
#include "runtime/render/frame_limits.h"
#include "runtime/scene/render_settings.h"

namespace pointrt {

/// What is written of each picture of a list of cameras.
struct CameraOutput {
    bool rgb = true, albedo = false, depth = true, normal = true, instance = false, exr = true;
    std::optional<double> depth_unit; ///< of a depth's whole numbers; none: as small as the scene allows
    bool operator==(const CameraOutput&) const = default;
};

/// What the command line says; resolveSettings (settings.h) puts it together with what a scene file says.
struct Options {
    std::string scene;
    std::string output;            ///< ends in .png or .exr, or "-", or a folder for cameras; empty for a window, with
                                   ///< bench_frames or list_devices
    std::string device;            ///< a selector, see DeviceRequest
    std::string stats;             ///< file for the report, "-" for standard output, empty for none
    RenderChoices choices;         ///< the rows of render_setting_table.h
    CameraRequest camera;          ///< but for its fov_deg
    std::optional<Vec3> up_axis;   ///< of the scene too, where that does not say; camera has it as well
    std::optional<double> fov_deg; ///< empty where nothing is said
    FrameLimits limits;
    std::optional<std::uint64_t> memory; ///< bytes for pictures of sets; else kTileMemory
    std::string view;                    ///< name of a view in the scene file, empty: its camera
    std::string cameras;                 ///< a list of them, empty for none; output is then a folder
    CameraOutput camera_output;          ///< what it gets of each
    bool drops_distortion = false;       ///< of their lenses
    std::uint32_t turntable = 0;         ///< pictures of a turntable, 0: none; output is then a pattern (turntable.h)
    std::uint32_t thumbnail = 0;         ///< pixels of its sides, 0: none; output is then a PNG whatever its name
    bool resume = false;                 ///< go on with the film in output, which ends in .exr
    std::uint32_t bench_frames = 0;      ///< 0: no benchmark
    bool list_devices = false;
    bool profile = false; ///< goes with output or bench_frames
    // without output and bench_frames there is a window
    std::string record, replay; ///< files of what the user does (window/recording.h), empty for none
    bool offscreen = false;     ///< a window that is not shown
    bool quiet = false, verbose = false;
    bool progress_lines = false; ///< for programs that show it in their own way
};

/// True where output is a PNG: FILE.png, a thumbnail, or "-", which is standard output.
bool writesPng(const Options& options);

/// True where what options ask for is a window.
bool opensWindow(const Options& options);

/// Fills options from the command line. Returns an exit code where the run ends here (--help and --version, whose text
/// goes to standard output). Throws Error kBadUsage with one line for anything wrong.
std::optional<int> parseOptions(int argc, const char* const* argv, Options& options);

} // namespace pointrt

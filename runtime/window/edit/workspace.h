// SPDX-License-Identifier: Apache-2.0
// What the window's panels show and change: plain data between the user interface and what does the work. Panels write
// here what the user wants; the window (window.cpp) reads it once a frame, does it, and fills in what has come of it.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "runtime/scene/legend.h"
#include "runtime/scene/render_settings.h"
#include "runtime/scene/scene_description.h"
#include "runtime/window/input/view_camera.h"
#include "runtime/window/live/display_pipeline.h"

namespace pointrt {

/// What was under the cursor. Positions and lengths in the scan's own coordinates.
struct PickedPoint {
    std::uint32_t splat = 0;
    std::string source; ///< the file or shape that it is of
    Vec3 position, normal;
    double distance = 0;                              ///< from the eye
    double radius = 0;                                ///< of the splat; 0 on shapes
    std::optional<std::array<std::uint8_t, 3>> color; ///< sRGB, where the file has colours
    std::string value;                                ///< that it is coloured by, in words; empty: by none
};

/// What the window says of itself.
struct HudStats {
    std::string device;
    std::uint64_t splats = 0, device_bytes = 0;
    std::uint32_t samples = 0, target_samples = 0;
    double sample_share = 0;                             ///< of the sample under way
    bool resting = false;                                ///< the picture has all its samples
    std::uint32_t picture_width = 0, picture_height = 0; ///< what is traced now, pixels
    double frame_ms = 0;                                 ///< a recent mean
    double mrays_per_second = 0;
    std::size_t tiles = 0, target_tiles = 0; ///< of sets: on the device, and for the camera as it is
    bool tiles_loading = false;
};

/// Work that takes long: loading, baking, rendering to a file.
struct JobStatus {
    std::string title;                  ///< "Baking statue.ply"
    std::string detail;                 ///< stage or count; may be empty
    std::optional<double> progress;     ///< done, 0 to 1; empty: unknown
    std::optional<double> seconds_left; ///< empty: unknown
    bool can_cancel = true;
};

/// A line that is shown for a few seconds.
struct Notice {
    std::string text;
    bool error = false;
    double until_s = 0; ///< on the window's clock
};

/// What the user asked for in this frame; done, and set back, by the window.
struct Requests {
    bool scene_changed = false;    ///< scene's lights, materials, shapes or sky were edited
    bool settings_changed = false; ///< settings were edited (integrator, bounces, room, shadows, caustics...)
    bool look_changed = false;     ///< look or denoise: the same light is shown another way
    bool dragging = false;         ///< an edit is under way: more of the same is to come
    std::optional<Vec3> up;        ///< the scan stands on another side: an axis
    bool save_scene = false, screenshot = false, save_view = false, home = false, quit = false;
    bool cancel_job = false;
    std::optional<std::size_t> go_to_view, delete_view; ///< of scene.views
    std::optional<std::uint32_t> turntable_pictures;    ///< render so many to turntable_path
};

struct Workspace {
    SceneDescription scene; ///< with all that stands around the scan, as it is lit now
    RenderSettings settings;
    std::uint32_t target_samples = 256;
    Look look;
    bool denoise = true;
    ViewCamera camera;
    Vec3 scene_up{0, 1, 0};    ///< what rooms stand on; unit length
    Vec3 scene_min, scene_max; ///< bounds of the scan, input coordinates
    bool paused = false;
    bool show_panel = true, show_cheat_sheet = false, show_hud = true;
    bool pin_measurement = false;
    std::vector<PickedPoint> picks;       ///< the last two, oldest first
    std::vector<std::string> color_words; ///< for settings.color_by
    std::optional<Legend> legend;         ///< of the colours on the device
    HudStats hud;
    std::optional<JobStatus> job;
    std::vector<Notice> notices;
    std::string turntable_path = "turntable/%04d.png";
    std::string view_name; ///< for the next saved view; empty: it gets a number
    std::string title;     ///< of the file
    double time_s = 0;     ///< the window's clock
    Requests requests;
};

} // namespace pointrt

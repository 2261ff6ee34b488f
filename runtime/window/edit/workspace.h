// SPDX-License-Identifier: Apache-2.0
// State shared by the panels and the window, as plain data. Panels write the user's requests; the window (window.cpp)
// reads them once per frame, executes them and fills in the results.
#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "runtime/device_scene/number_samples.h"
#include "runtime/scene/legend.h"
#include "runtime/scene/render_settings.h"
#include "runtime/scene/scene_description.h"
#include "runtime/session/scan_frame.h"
#include "runtime/window/edit/file_browser.h"
#include "runtime/window/input/controls.h"
#include "runtime/window/input/view_camera.h"
#include "runtime/window/live/display_pipeline.h"

namespace pointrt {

/// A picked point. Positions and lengths in the scan's own coordinates.
struct PickedPoint {
    std::uint32_t splat = 0;
    std::string source; ///< name of the file or shape
    Vec3 position, normal;
    double distance = 0;                              ///< from the eye
    double radius = 0;                                ///< of the splat; 0 for shapes
    std::optional<std::array<std::uint8_t, 3>> color; ///< sRGB; none if the file has no colours
    std::string value;                                ///< the value that gives its colour, as text; empty: none
};

/// Statistics shown in the corner.
struct HudStats {
    std::string device;
    std::uint64_t splats = 0, device_bytes = 0;
    std::uint32_t samples = 0, target_samples = 0;
    double sample_share = 0;                             ///< progress of the current sample, 0 to 1
    bool resting = false;                                ///< all samples are done
    std::uint32_t picture_width = 0, picture_height = 0; ///< being traced, pixels
    double frame_ms = 0;                                 ///< recent mean
    double mrays_per_second = 0;
    std::size_t tiles = 0, target_tiles = 0; ///< of tile sets: on the device, and in the cut for the camera
    bool tiles_loading = false;
};

/// State of a job, for display.
struct JobStatus {
    std::string title;                  ///< "Baking statue.ply"
    std::string detail;                 ///< stage or count; may be empty
    std::optional<double> progress;     ///< 0 to 1; none: unknown
    std::optional<double> seconds_left; ///< none: unknown
    bool can_cancel = true;
};

/// A message shown for a few seconds.
struct Notice {
    std::string text;
    bool error = false;
    double until_s = 0; ///< on the window's clock
};

/// A question that must be answered before anything else happens.
struct Question {
    std::string text;
    std::vector<std::string> answers; ///< on buttons; Esc gives the last one
};

/// Two scans of a scene, by their numbers: distances of the compared one from the surface of the reference.
struct Comparison {
    std::size_t reference = 0, compared = 0;
};

/// A picture that waits to be rendered to a file.
struct Still {
    SceneDescription scene; ///< as shown
    PixelSize size;
    std::string path;
};

/// The user's requests in this frame. The window executes and resets them.
struct Requests {
    bool scene_changed = false;    ///< lights, materials, shapes or sky were edited
    bool settings_changed = false; ///< settings were edited (integrator, bounces, room, shadows, caustics...)
    bool look_changed = false;     ///< look or denoise changed: the same light is shown another way
    bool dragging = false;         ///< an edit is in progress: more changes of its kind follow
    bool typing = false;           ///< a text field has the keyboard
    bool undo = false, redo = false;
    bool open = false;                   ///< show the dialog for files to open
    std::optional<Action> action;        ///< chosen from a list
    std::optional<std::string> browse;   ///< folder for the browser
    std::vector<std::string> open_files; ///< chosen in the browser
    std::optional<Vec3> up;              ///< new up axis
    bool keep_measurement = false;       ///< make the picks a part of the scene
    bool save_measurement = false;
    bool save_scene = false, screenshot = false, save_view = false, home = false, quit = false;
    bool cancel_job = false;
    std::optional<std::size_t> answer;                  ///< index into question's answers
    std::optional<std::size_t> open_recent;             ///< index into recent_files
    std::optional<std::size_t> go_to_view, delete_view; ///< indices into scene.views
    bool find_place = false;                            ///< earth_place of the scene
    bool add_still = false;                             ///< add the displayed picture to work.stills
    bool follows_views = false;                         ///< turntable_pictures follow the views
    std::optional<std::string> bake_again;              ///< bake again with this kind of splats
    std::optional<std::size_t> save_outline;            ///< number of a clip
    std::optional<Comparison> compare;
    std::optional<std::uint32_t> turntable_pictures; ///< number of frames to render to turntable_path
};

struct Workspace {
    SceneDescription scene; ///< with surroundings, as displayed
    RenderSettings settings;
    std::uint32_t target_samples = 256;
    Look look;
    bool denoise = true;
    ViewCamera camera;
    Vec3 scene_up{0, 1, 0};    ///< unit length
    Vec3 scene_min, scene_max; ///< of the scans, input coordinates
    bool paused = false;
    bool show_panel = true, show_cheat_sheet = false, show_hud = true;
    bool show_palette = false;
    bool light_theme = false;
    /// Sections of the panel by name: whether they are open; others have their defaults.
    std::map<std::string, bool> open_sections;
    bool pin_measurement = false;
    std::vector<PickedPoint> picks;       ///< oldest first: the last two, or with pin_measurement all of a path
    MeasureUnits measure_units;           ///< of the scene that is open
    std::vector<Vec3> scan_centres;       ///< of the instances' bounds, in the coordinates of their files
    std::vector<std::string> color_words; ///< choices for settings.color_by
    std::map<std::string, NumberHistogram> histograms; ///< of the attributes of scene.filters
    std::optional<Legend> legend;                      ///< of the current colours
    HudStats hud;
    std::optional<JobStatus> job;
    std::vector<std::string> recent_files; ///< to start with; paths, the latest first
    std::optional<FileBrowser> browser;    ///< while files are chosen in it
    std::optional<Question> question;
    PixelSize still_size{3840, 2160};
    std::vector<Still> stills; ///< in their order
    bool can_undo = false, can_redo = false;
    std::optional<EarthPlace> earth_place;          ///< of the scans, if it was determined
    bool place_sought = false, place_taken = false; ///< place_taken: used by the sun's sliders
    bool may_bake_again = false;
    bool scan_in_view = true;    ///< false: the camera looks past the scans
    bool only_gaussians = false; ///< see StudioSubject
    std::vector<Notice> notices;
    std::string turntable_path = "turntable/%04d.png"; ///< or a video; opening a scene puts it beside the scene
    std::optional<std::size_t> shown_view;             ///< in scene.views: the last one gone to
    std::string view_name;                             ///< for the next saved view; empty: "view N"
    std::string title;                                 ///< the file's name
    double time_s = 0;                                 ///< the window's clock
    Requests requests;
};

/// Whether a scene is open.
inline bool hasScene(const Workspace& work) { return !work.scene.instances.empty() || !work.scene.shapes.empty(); }

} // namespace pointrt

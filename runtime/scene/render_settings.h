// SPDX-License-Identifier: Apache-2.0
// What to render: plain structs that the command line and scene files fill and the tracer reads.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>

#include "runtime/scene/background.h"
#include "runtime/scene/color_map.h"
#include "runtime/scene/integrator.h"
#include "runtime/scene/standard_view.h"
#include "runtime/util/names.h"
#include "runtime/util/pixel_size.h"
#include "runtime/util/vec.h"

namespace pointrt {

enum class Room { kNone, kMirror, kMatte };
inline constexpr std::array kRoomNames = {Name{"none", Room::kNone}, Name{"mirror", Room::kMirror},
                                          Name{"matte", Room::kMatte}};

enum class DenoiseChoice { kAuto, kOn, kOff };
inline constexpr std::array kDenoiseNames = {Name{"on", DenoiseChoice::kOn}, Name{"off", DenoiseChoice::kOff},
                                             Name{"auto", DenoiseChoice::kAuto}};

/// The parts of the camera that the user gives, in input coordinates; frameScene and frameCamera complete it.
struct CameraRequest {
    std::optional<Vec3> eye, target, up;
    double fov_deg = 40; ///< vertical, in (0, 180); not used by parallel projection
    bool ortho = false;  ///< parallel projection; implied by ortho_height
    /// Height of the picture in the scene, input units, above 0; not set: shows the whole scene.
    std::optional<double> ortho_height;
    bool panorama = false;   ///< equirectangular, all around the eye; not with parallel projection
    double eyes_apart_m = 0; ///< of a panorama: distance between the eyes; above 0 for stereo
    Vec3 side{0, 0, 1};      ///< unit vector from the target to the eye, used if eye is not set
    bool keeps_side = false; ///< frameScene keeps side and does not look for a better one
    /// The view for frameScene if eye is not set; if this is not set either, frameScene chooses one.
    std::optional<StandardView> view;
    bool operator==(const CameraRequest&) const = default;
};

/// A complete camera in input coordinates; right, up and forward are orthonormal, except for pinholeCamera (pinhole.h).
/// With parallel projection all rays start on the plane through the eye and go forward.
struct Camera {
    Vec3 eye, right, up, forward;
    double fov_deg = 40;     ///< vertical
    double ortho_height = 0; ///< above 0: parallel projection, with the picture's height in input units
    bool panorama = false;   ///< equirectangular (panorama.h); forward is in the middle of the picture
    /// For panoramas: distance between the eyes in input units. If above 0, the left eye's picture is above the right
    /// eye's.
    double eyes_apart = 0;
    bool operator==(const Camera&) const = default;
};

/// Largest number of samples per pixel: one more sample must still change a 32-bit float that holds their sum.
constexpr std::uint32_t kMaxSpp = 65536;

/// The value of RenderSettings::color_by for the scans' own colours.
inline constexpr const char* kOwnColors = "rgb";

/// Render settings. render_setting_table.h defines their ranges and where users set them.
struct RenderSettings {
    std::uint32_t width = 512, height = 512; ///< pixels
    std::uint32_t spp = 4;                   ///< samples per pixel
    std::uint32_t seed = 0;
    CameraRequest camera;
    Integrator integrator = Integrator::kPhong;
    std::uint32_t bounces = 4;            ///< secondary rays in a path
    std::optional<Room> room;             ///< a box around the scene
    std::optional<std::uint32_t> lights;  ///< point lights on the ring
    std::optional<Background> background; ///< replaces sky, studio floor and tone curve (default_lighting.h)
    bool shadows = true;
    bool caustics = true; ///< light focused by glass and mirrors
    bool blend = true;    ///< off: each hit is one splat's flat disc
    float splat_size = 1; ///< factor for the radii of splats, above 0 and at most 1, since cells list no larger splats
    bool relight = false; ///< Gaussians are surfaces that the scene's lights illuminate
    std::optional<float> reflectivity; ///< overrides the scans' materials
    std::string color_by = kOwnColors; ///< see color_choice.h of device_scene
    std::optional<ColorMap> color_map;
    std::optional<ValueRange> color_range; ///< values at the ends of the colour map
    std::optional<bool> legend;            ///< default: on in windows, off in files
    bool first_hits = false;               ///< also fill the film's depth, normal and position
    bool light_parts = true;               ///< also fill the film's direct, indirect and caustic light
    DenoiseChoice denoise = DenoiseChoice::kAuto;
    float exposure = 0; ///< stops, for 8-bit pictures
    float detail = 1;   ///< largest level-of-detail error of tile sets, pixels (CutRequest::detail)
};

/// Default samples per pixel where the viewer chooses path tracing by itself. Path tracing and denoising 800 x 800
/// pixels of a million splats then takes 6 to 8 s of processor time.
constexpr std::uint32_t kDefaultPathSpp = 8;

/// The settings that the command line or a scene file gives; none: not given.
struct RenderChoices {
    std::optional<PixelSize> size;
    std::optional<std::uint32_t> spp, seed;
    std::optional<Integrator> integrator;
    std::optional<std::uint32_t> bounces;
    std::optional<Room> room;
    std::optional<std::uint32_t> lights;
    std::optional<Background> background;
    std::optional<bool> shadows, caustics, blend, relight;
    std::optional<float> reflectivity;
    std::optional<std::string> color_by;
    std::optional<ColorMap> color_map;
    std::optional<ValueRange> color_range;
    std::optional<bool> legend;
    std::optional<DenoiseChoice> denoise;
    std::optional<float> exposure, detail, splat_size;
    bool operator==(const RenderChoices&) const = default;
};

} // namespace pointrt

// SPDX-License-Identifier: Apache-2.0
// What to render: the plain structs between the command line, scene files and the tracer.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>

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

/// What the user said of the camera, in input coordinates; what is missing is framed by frameCamera.
struct CameraRequest {
    std::optional<Vec3> eye, target, up;
    double fov_deg = 40; ///< vertical, in (0, 180); nothing to a parallel projection
    bool ortho = false;  ///< parallel projection, for which ortho_height asks as well
    /// Height of the picture's window in the scene, input units, above 0; where not given it shows all of the scene.
    std::optional<double> ortho_height;
    Vec3 side{0, 0, 1}; ///< unit vector from the target to the eye, where no eye is given
    /// Where neither eye nor target is given: what frameScene (runtime/scene) looks from, in place of its own choice.
    std::optional<StandardView> view;
    bool operator==(const CameraRequest&) const = default;
};

/// A complete camera in input coordinates; right, up and forward are orthonormal, but for pinholeCamera's (pinhole.h).
/// With parallel projection all rays go forward, from a window around the eye: nothing behind that is seen.
struct Camera {
    Vec3 eye, right, up, forward;
    double fov_deg = 40;     ///< vertical
    double ortho_height = 0; ///< above 0: parallel projection, the height in input units that the picture shows
    bool operator==(const Camera&) const = default;
};

/// The most samples a pixel can have: sums of them in 32-bit floats still gain by one more.
constexpr std::uint32_t kMaxSpp = 65536;

/// RenderSettings::color_by of scans that have the colours of their files.
inline constexpr const char* kOwnColors = "rgb";

/// What decides a picture besides its scene. render_setting_table.h has what each may be, and where users say it.
struct RenderSettings {
    std::uint32_t width = 512, height = 512; ///< pixels
    std::uint32_t spp = 4;                   ///< samples a pixel
    std::uint32_t seed = 0;
    CameraRequest camera;
    Integrator integrator = Integrator::kPhong;
    std::uint32_t bounces = 4;           ///< secondary rays in a path
    std::optional<Room> room;            ///< a box around the scene
    std::optional<std::uint32_t> lights; ///< point lights on the ring
    bool shadows = true;
    bool caustics = true;              ///< light bundled by glass and mirrors
    bool blend = true;                 ///< off: each hit is one splat's flat disc
    std::optional<float> reflectivity; ///< overrules what scans' files say
    std::string color_by = kOwnColors; ///< what scans are coloured by: see color_words.h of device_scene
    std::optional<ColorMap> color_map;
    std::optional<ValueRange> color_range; ///< of the map's ends
    std::optional<bool> legend;            ///< of the colours; where nothing is said in windows, not in files
    bool first_hits = false;               ///< also fill the Film's depth, normal and position
    bool light_parts = true;               ///< also fill its direct, indirect and caustic: to go on later, or to keep
    DenoiseChoice denoise = DenoiseChoice::kAuto;
    float exposure = 0; ///< stops, for 8-bit pictures
    float detail =
        1; ///< pixels: what a tile of a set leaves out may be so large (CutRequest::detail of runtime/device_scene)
};

/// What the command line or a scene file says of them; empty where it is silent.
struct RenderChoices {
    std::optional<PixelSize> size;
    std::optional<std::uint32_t> spp, seed;
    std::optional<Integrator> integrator;
    std::optional<std::uint32_t> bounces;
    std::optional<Room> room;
    std::optional<std::uint32_t> lights;
    std::optional<bool> shadows, caustics, blend;
    std::optional<float> reflectivity;
    std::optional<std::string> color_by;
    std::optional<ColorMap> color_map;
    std::optional<ValueRange> color_range;
    std::optional<bool> legend;
    std::optional<DenoiseChoice> denoise;
    std::optional<float> exposure, detail;
    bool operator==(const RenderChoices&) const = default;
};

} // namespace pointrt

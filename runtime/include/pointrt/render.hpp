// SPDX-License-Identifier: Apache-2.0
// Renders pictures of scans to arrays, bit-identical to the OpenEXR files of pointrt-view.
//
//   pointrt::TraceDevice device;
//   pointrt::PictureRenderer renderer(device, {"scan.pro"}, {{"integrator", "path"}, {"spp", "16"}});
//   const pointrt::PinholeCamera camera{.fx = 500, .fy = 500, .cx = 320, .cy = 240, .world_from_camera = pose};
//   const pointrt::Picture picture = renderer.render(camera, 640, 480, {"rgba", "depth"});
//   picture.layer("depth").floats[640 * y + x]
//
// Everything throws TraceError or std::bad_alloc. Threads may share a renderer; it renders one picture at a time.
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "pointrt/trace.hpp"

namespace pointrt {

/// A camera as with pointrt-view's --eye, --target, --up and --fov, in the scan's coordinates. Missing parts are chosen
/// automatically: an empty LookAt sees the whole scene from the side that shows most of it.
struct LookAt {
    std::optional<std::array<double, 3>> eye = {}, target = {};
    std::optional<std::array<double, 3>> up = {}; ///< of the picture; none: the scene's
    std::optional<double> fov_deg = {};           ///< vertical, from 0.001 to below 180; none: 40
};

/// A calibrated camera without distortion. Image coordinates are in pixels, x to the right and y down, with the centre
/// of the top left pixel at (0.5, 0.5).
struct PinholeCamera {
    double fx = 0, fy = 0; ///< focal lengths in pixels, above 0
    double cx = 0, cy = 0; ///< principal point in pixels, inside or outside the picture
    /// A row-major 4x4 matrix: a rotation, the camera's position in the scan's coordinates, and 0 0 0 1. The camera's
    /// axes are x right, y down, z forward, as in OpenCV and COLMAP. Negate the second and third column of poses from
    /// nerfstudio, Blender and OpenGL.
    std::array<double, 16> world_from_camera = {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1};
};

using PictureCamera = std::variant<LookAt, PinholeCamera>;

/// The kind of a layer.
struct PictureLayerKind {
    std::string name;                  ///< such as "rgba", "depth", "splat_id"
    std::vector<std::string> channels; ///< names in OpenEXR files: "R" "G" "B" "A"; "Z"; "id.splat"
    bool is_words = false;             ///< 32-bit unsigned integers, else floats
};

/// The values of each pixel, one per channel, rows from the top.
struct PictureLayer {
    PictureLayerKind kind;
    std::vector<float> floats;        ///< [height][width][channels], empty if kind.is_words
    std::vector<std::uint32_t> words; ///< [height][width][channels], empty unless kind.is_words
};

struct Picture {
    std::uint32_t width = 0, height = 0;
    std::vector<PictureLayer> layers;

    /// Throws kBadUsage if the picture has no layer of that name.
    const PictureLayer& layer(const std::string& name) const;
};

/// Render settings, by the names of pointrt-view's options without the leading dashes: {"integrator", "path"},
/// {"bounces", "8"}, {"spp", "64"}, {"seed", "7"}, {"lights", "3"}, {"color-by", "height"}. Also "up", the scene's up
/// direction; "memory", the limit for tiles of sets; and "staged-for", "X,Y,Z": the eye for which default lights and
/// rooms are placed (default: the default camera's). Names may have _ in place of -. Sun, sky and materials need scene
/// files.
using PictureSettings = std::map<std::string, std::string>;

/// All layers:
///  - rgba         linear colour, including the background; coverage of the pixel by the scene
///  - depth        distance from the eye along the ray through the pixel's centre, in scan units; +infinity for a miss
///  - normal       of the first hit, unit length, towards the eye; 0 for a miss
///  - position     of the first hit, rounded to float; compute it from depth for large coordinates
///  - direct, indirect, caustic   the light components
///  - albedo       reflectance of the first hit
///  - splat_id, tile_id, instance_id, material_id   of the first hit; kNoHit for a miss
///  - samples, variance   samples of the pixel; variance of its mean luminance, +infinity below two samples
const std::vector<PictureLayerKind>& pictureLayers();

/// A scene on a device with fixed settings, to be rendered from any camera.
class PictureRenderer {
public:
    /// @param paths one .pro file, tile set (.proset) or scene file (.toml), or several of the first two
    /// Throws kBadInput "FILE: reason" as pointrt-view does, kBadUsage "SETTING: reason", kCannotRun if the device has
    /// too little memory.
    PictureRenderer(const TraceDevice& device, const std::vector<std::string>& paths,
                    const PictureSettings& settings = {});
    ~PictureRenderer();
    PictureRenderer(PictureRenderer&&) noexcept;
    PictureRenderer& operator=(PictureRenderer&&) noexcept;

    /// Renders a picture with the named layers, in the order of pictureLayers().
    /// @param width, height in pixels, 1 to 16384 each
    /// @param give_up optional; polled on the calling thread, cancels the rendering by returning true
    /// Throws kBadUsage for invalid cameras, sizes and layers, kCannotRun for insufficient memory, a lost device or a
    /// cancelled picture.
    Picture render(const PictureCamera& camera, std::uint32_t width, std::uint32_t height,
                   const std::vector<std::string>& layers, const std::function<bool()>& give_up = {});

    struct State;

private:
    std::unique_ptr<State> state_;
};

} // namespace pointrt

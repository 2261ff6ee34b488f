// SPDX-License-Identifier: Apache-2.0
// Pictures of scans in memory: what pointrt-view writes to OpenEXR files, as arrays, the same to the bit.
//
//   pointrt::TraceDevice device;
//   pointrt::PictureRenderer renderer(device, {"scan.pro"}, {{"integrator", "path"}, {"spp", "16"}});
//   const pointrt::PinholeCamera camera{.fx = 500, .fy = 500, .cx = 320, .cy = 240, .world_from_camera = pose};
//   const pointrt::Picture picture = renderer.render(camera, 640, 480, {"rgba", "depth"});
//   picture.layer("depth").floats[640 * y + x]
//
// Everything throws TraceError or std::bad_alloc. Threads may share a renderer; it makes one picture at a time.
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

/// What pointrt-view's --eye, --target, --up and --fov say, in the scan's coordinates. What is left out is framed as
/// there: with nothing said, all of the scene is seen from the side that shows most of it.
struct LookAt {
    std::optional<std::array<double, 3>> eye = {}, target = {};
    std::optional<std::array<double, 3>> up = {}; ///< of the picture; none: the scene's
    std::optional<double> fov_deg = {};           ///< vertical, 0.001 up to below 180; none: 40
};

/// A machine's camera, without distortion. Places in the picture are in pixels, x to the right and y down, the top left
/// pixel's centre at (0.5, 0.5).
struct PinholeCamera {
    double fx = 0, fy = 0; ///< focal lengths, above 0
    double cx = 0, cy = 0; ///< principal point, anywhere
    /// Row by row: a rotation, the camera's place in the scan's coordinates, and 0 0 0 1. The camera's x goes to the
    /// right, y down, z where it looks, as in OpenCV and COLMAP. Turn the second and third column around for poses of
    /// nerfstudio, Blender and OpenGL.
    std::array<double, 16> world_from_camera = {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1};
};

using PictureCamera = std::variant<LookAt, PinholeCamera>;

/// A layer that pictures may have.
struct PictureLayerKind {
    std::string name;                  ///< such as "rgba", "depth", "splat_id"
    std::vector<std::string> channels; ///< what OpenEXR files call its numbers: "R" "G" "B" "A"; "Z"; "id.splat"
    bool is_words = false;             ///< else floats
};

/// Numbers of each pixel, rows from the top, as many as the kind has channels.
struct PictureLayer {
    PictureLayerKind kind;
    std::vector<float> floats;        ///< [height][width][channels], or empty
    std::vector<std::uint32_t> words; ///< the same
};

struct Picture {
    std::uint32_t width = 0, height = 0;
    std::vector<PictureLayer> layers;

    /// Throws kBadUsage where there is none of that name.
    const PictureLayer& layer(const std::string& name) const;
};

/// What decides a picture besides its scene and camera, in pointrt-view's words for its options, without the dashes:
/// {"integrator", "path"}, {"bounces", "8"}, {"spp", "64"}, {"seed", "7"}, {"lights", "3"}, {"color-by", "height"}.
/// Also "up", what is up in the scene; "memory", bytes for the tiles of sets; and "staged-for", "X,Y,Z": the eye that
/// lights and rooms are put up for where the scene has none, which is the default camera's otherwise. A _ stands for a
/// - as well. Sun, sky and materials come from scene files.
using PictureSettings = std::map<std::string, std::string>;

/// All layers that there are:
///  - rgba         linear light, background included; share of the pixel that the scene covers
///  - depth        along the ray through the pixel's centre, from the eye, in the scan's unit; +infinity where nothing
///  is
///  - normal       of the first hit there, unit length, towards the eye; 0 where nothing is
///  - position     of the first hit, rounded to float: depth has what national grids lose
///  - direct, indirect, caustic   the parts of the light
///  - albedo       reflectance of the first hit: colours without light
///  - splat_id, tile_id, instance_id, material_id   of the first hit; kNoHit where there is none
///  - samples, variance   paths through the pixel; of the mean luminance, +infinity below two samples
const std::vector<PictureLayerKind>& pictureLayers();

/// A scene on a device, with settings, ready for any cameras.
class PictureRenderer {
public:
    /// @param paths one .pro file, tile set (.proset) or scene file (.toml), or several of the first two
    /// Throws kBadInput "FILE: reason" as pointrt-view does, kBadUsage "SETTING: reason", kCannotRun where the device
    /// is too small.
    PictureRenderer(const TraceDevice& device, const std::vector<std::string>& paths,
                    const PictureSettings& settings = {});
    ~PictureRenderer();
    PictureRenderer(PictureRenderer&&) noexcept;
    PictureRenderer& operator=(PictureRenderer&&) noexcept;

    /// A picture, with the layers that are named, in the order of pictureLayers().
    /// @param width, height in pixels, 1 to 16384 each
    /// @param give_up may be empty; asked every now and then on the calling thread, ends the work where it says true
    /// Throws kBadUsage for cameras, sizes and layers that are none, kCannotRun for too little memory, a lost device or
    /// a picture that was given up.
    Picture render(const PictureCamera& camera, std::uint32_t width, std::uint32_t height,
                   const std::vector<std::string>& layers, const std::function<bool()>& give_up = {});

    struct State;

private:
    std::unique_ptr<State> state_;
};

} // namespace pointrt

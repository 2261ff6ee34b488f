// SPDX-License-Identifier: Apache-2.0
// Renders a .pro in this process, with the validation layer on where it is installed.
#pragma once

#include <cstddef>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "runtime/image/film.h"
#include "runtime/render/frame_params.h"
#include "runtime/render/kernel_form.h"
#include "runtime/scene/render_settings.h"
#include "runtime/scene/scene_description.h"

namespace pointrt::test {

struct Rendered {
    Film film;
    KernelForm form = KernelForm::kWavefront; ///< form of the kernels that rendered it
    RayCounts rays;
    Camera camera;
    gpu::FrameParams params{}; ///< the parameters that the shaders read
    pro_info info{};           ///< of the first instance
    double cell_edge = 0;      ///< of its bricks, cube units
    SceneDescription scene;    ///< with its default surroundings
};

/// size x size pixels, one sample through each centre, three lights on the ring, no room.
RenderSettings square(std::uint32_t size);

/// first_hits is always on. form: the kernel form. strip_rows: the rows of a strip, with each pass submitted by itself,
/// as windows do; 0: as for frames.
Rendered renderScene(SceneDescription scene, RenderSettings settings, FormRequest form = {},
                     std::uint32_t strip_rows = 0);
/// The same for a .pro alone.
Rendered renderFile(const std::string& path, RenderSettings settings);

/// A unit sphere of splats around the origin, normals outwards, as a .pro for as long as this lives.
struct SphereFile {
    explicit SphereFile(std::size_t splats);
    ~SphereFile();
    SphereFile(const SphereFile&) = delete;
    SphereFile& operator=(const SphereFile&) = delete;
    std::string path;
};

/// The splats of a file, all of one material, in darkness.
SceneDescription splatBody(const std::string& path, const MaterialDescription& material);
/// The same for the analytic unit sphere around the origin.
SceneDescription analyticSphere(const MaterialDescription& material);
/// The same radiance from all directions; phong and whitted take that share of it as ambient light.
SkyDescription evenSky(float radiance, float ambient = 0);

/// Writes an equirectangular picture for SkyDescription::image, height rows and twice as many columns, and returns its
/// path; calls radiance with the direction of each texel's centre.
std::string writeSky(const std::string& name, std::uint32_t height, const std::function<Color(Vec3)>& radiance);
/// Radiance (1 + direction) / 2 from each direction.
Color directionColor(Vec3 direction);
/// The direction whose directionColor is in pixel i, not normalized: its length is 1 only if all samples have the same
/// direction.
Vec3 colorDirection(const Film& film, std::size_t i);

/// Distance of a ray's first hit with the unit sphere around the origin. direction: of unit length
std::optional<double> meetSphere(Vec3 start, Vec3 direction);

/// Degrees between two directions.
double angleBetween(Vec3 a, Vec3 b);
struct Spread {
    double mean = 0, median = 0, p99 = 0, largest = 0;
};
/// values must not be empty.
Spread spreadOf(std::vector<double> values);

/// Channel c of pixel (x, y).
float pixel(const Film& film, std::uint32_t x, std::uint32_t y, int channel);

} // namespace pointrt::test

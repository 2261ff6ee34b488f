// SPDX-License-Identifier: Apache-2.0
#include "runtime/render/frame_params.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "runtime/scene/camera.h"
#include "runtime/scene/default_lighting.h"
#include "runtime/scene/panorama.h"

namespace pointrt {

namespace {

gpu::vec3 scaled(Color color, float strength) {
    return {color[0] * strength, color[1] * strength, color[2] * strength};
}

gpu::vec3 packed(Vec3 v) { return {static_cast<float>(v.x), static_cast<float>(v.y), static_cast<float>(v.z)}; }

std::uint32_t optionBits(const RenderSettings& settings) {
    const bool is_transparent = settings.background && settings.background->transparent;
    return (settings.blend ? OPTION_BLEND : 0u) | (settings.shadows ? OPTION_SHADOWS : 0u) |
           (is_transparent ? OPTION_TRANSPARENT : 0u);
}

/// A sky image is sampled as a light, with shadows, so it adds no ambient light.
void setSky(const SkyDescription& sky, gpu::FrameParams& params) {
    params.sky_zenith = scaled(sky.zenith, sky.strength);
    params.ambient_share = sky.image.empty() ? sky.ambient : 0.0f;
    params.sky_horizon = scaled(sky.horizon, sky.strength);
    params.sky_ground = scaled(sky.ground, sky.strength);
}

/// Half heights of the plane at distance 1 that rays go through and of the window that they start in; one of them is 0
/// (shaders/lib/camera_ray.glsl).
struct HalfHeights {
    double at_distance_1 = 0;
    double window = 0; ///< input units
};

HalfHeights halfHeights(const Camera& camera) {
    if (camera.ortho_height > 0) return {0, camera.ortho_height / 2};
    return {std::tan(verticalHalfAngle(camera.fov_deg)), 0};
}

/// The vector from the centre of the picture to the centre of pixel (x, y), in half heights of the picture.
Vec3 pixelOffset(const RenderSettings& settings, const Camera& camera, std::uint32_t x, std::uint32_t y) {
    const double aspect = static_cast<double>(settings.width) / settings.height;
    const double across = (2.0 * (x + 0.5) / settings.width - 1.0) * aspect;
    const double upwards = 1.0 - 2.0 * (y + 0.5) / settings.height;
    return across * camera.right + upwards * camera.up;
}

PanoramaRay panoramaCenterRay(const RenderSettings& settings, const Camera& camera, std::uint32_t x, std::uint32_t y) {
    return panoramaRay(camera, (x + 0.5) / settings.width, (y + 0.5) / settings.height);
}

/// Margin of the box around all instances, as a share of its size: more than the rounding error of the ray test.
constexpr float kBoundsMargin = 1e-4f;

/// Half the edge of a box around everything; its square does not overflow a float.
constexpr float kEverywhere = 1e15f;

/// A point of an instance's cube in render space, by the transposed rows, since the rows are those of a scaled
/// rotation.
std::array<float, 3> renderFromCube(const gpu::InstanceParams& p, std::array<float, 3> cube) {
    const float x = cube[0] - p.row_x.w, y = cube[1] - p.row_y.w, z = cube[2] - p.row_z.w;
    const float squared = p.splat.w * p.splat.w;
    return {(p.row_x.x * x + p.row_y.x * y + p.row_z.x * z) / squared,
            (p.row_x.y * x + p.row_y.y * y + p.row_z.y * z) / squared,
            (p.row_x.z * x + p.row_y.z * y + p.row_z.z * z) / squared};
}

/// A corner of the entry grid, selected by three bits, in the cube.
std::array<float, 3> gridCorner(const gpu::InstanceParams& p, unsigned corner) {
    const auto end = [&](unsigned axis, std::uint32_t lowest, std::uint32_t cells) {
        return static_cast<float>(lowest + (corner >> axis & 1 ? cells : 0)) / p.grid_scale.x;
    };
    return {end(0, p.grid_origin.x, p.grid_size.x), end(1, p.grid_origin.y, p.grid_size.y),
            end(2, p.grid_origin.z, p.grid_size.z)};
}

} // namespace

void setInstanceBounds(const DeviceScene& scene, gpu::FrameParams& params) {
    constexpr float kFar = std::numeric_limits<float>::max();
    std::array<float, 3> low{kFar, kFar, kFar}, high{-kFar, -kFar, -kFar};
    for (const Instance& instance : scene.instances) {
        // Gaussians that extend beyond their cube count as being everywhere
        const bool everywhere = scene.files[instance.file].reaches_out;
        if (everywhere) low.fill(-kEverywhere);
        if (everywhere) high.fill(kEverywhere);
        for (unsigned corner = 0; corner < 8; ++corner) {
            const std::array<float, 3> at = renderFromCube(instance.params, gridCorner(instance.params, corner));
            for (std::size_t axis = 0; axis < 3; ++axis) {
                low[axis] = std::min(low[axis], at[axis]);
                high[axis] = std::max(high[axis], at[axis]);
            }
        }
    }
    const float margin =
        scene.instances.empty() ? 0 : kBoundsMargin * std::max({high[0] - low[0], high[1] - low[1], high[2] - low[2]});
    params.instances_low = {low[0] - margin, low[1] - margin, low[2] - margin};
    params.instances_high = {high[0] + margin, high[1] + margin, high[2] + margin};
}

void setShapes(const DeviceScene& scene, gpu::FrameParams& params) {
    params.shape_count = static_cast<std::uint32_t>(scene.shape_rows.size());
    const auto held = std::min<std::size_t>(scene.shape_rows.size(), HELD_SHAPES);
    std::copy_n(scene.shape_rows.begin(), held, params.held_shapes);
}

gpu::FrameParams makeFrameParams(const DeviceScene& scene, const RenderSettings& settings, const Camera& camera,
                                 std::uint32_t first_row, std::uint32_t rows) {
    const RenderSpace& space = scene.space;
    const Vec3 center = 0.5 * (scene.bounds.lo + scene.bounds.hi);
    const double radius = 0.5 * length(scene.bounds.hi - scene.bounds.lo);
    gpu::FrameParams params{};
    const HalfHeights half = halfHeights(camera);
    params.eye = packed(renderPoint(space, camera.eye));
    params.tan_half_fov = static_cast<float>(half.at_distance_1);
    params.right = packed(camera.right);
    params.aspect = static_cast<float>(static_cast<double>(settings.width) / settings.height);
    params.up = packed(camera.up);
    params.half_window = static_cast<float>(half.window / space.scale);
    params.forward = packed(camera.forward);
    params.half_eye_distance = static_cast<float>(camera.eyes_apart / 2 / space.scale);
    setSky(scene.description.sky.value_or(SkyDescription{}), params);
    params.sky_up = packed(sceneUp(scene.description, settings));
    params.depth_black = static_cast<float>((length(camera.eye - center) + radius) / space.scale);
    params.width = settings.width;
    params.height = settings.height;
    params.first_row = first_row;
    params.rows = rows;
    params.light_count = static_cast<std::uint32_t>(scene.light_rows.size());
    params.options = optionBits(settings);
    setShapes(scene, params);
    params.sky_light = scene.sky_light;
    params.environment = scene.environment;
    params.film_pixels = settings.width * rows;
    params.picture_width = settings.width;
    params.picture_height = settings.height;
    params.integrator = static_cast<std::uint32_t>(settings.integrator);
    params.bounces = settings.bounces;
    params.seed = settings.seed;
    setInstanceBounds(scene, params);
    return params;
}

Vec3 centerRayOrigin(const RenderSettings& settings, const Camera& camera, std::uint32_t x, std::uint32_t y) {
    if (camera.panorama) return panoramaCenterRay(settings, camera, x, y).origin;
    return camera.eye + halfHeights(camera).window * pixelOffset(settings, camera, x, y);
}

Vec3 centerRayDirection(const RenderSettings& settings, const Camera& camera, std::uint32_t x, std::uint32_t y) {
    if (camera.panorama) return panoramaCenterRay(settings, camera, x, y).direction;
    return normalize(camera.forward + halfHeights(camera).at_distance_1 * pixelOffset(settings, camera, x, y));
}

} // namespace pointrt

// SPDX-License-Identifier: Apache-2.0
#include "runtime/frame_params.h"

#include <cmath>

#include "runtime/camera.h"
#include "runtime/staging.h"

namespace pointrt {

namespace {

gpu::vec4 pack(Color color, float strength, float w = 0) {
    return {color[0] * strength, color[1] * strength, color[2] * strength, w};
}

std::uint32_t optionBits(const RenderSettings& settings) {
    return (settings.blend ? OPTION_BLEND : 0u) | (settings.shadows ? OPTION_SHADOWS : 0u);
}

/// A picture lights the scene as a light does, with shadows: nothing of it is taken as ambient.
void setSky(const SkyDescription& sky, gpu::FrameParams& params) {
    params.sky_zenith = pack(sky.zenith, sky.strength, sky.image.empty() ? sky.ambient : 0.0f);
    params.sky_horizon = pack(sky.horizon, sky.strength);
    params.sky_ground = pack(sky.ground, sky.strength);
}

/// Of what rays go through and of the window that they start in: one of them is 0 (shaders/camera_ray.glsl).
struct HalfHeights {
    double at_distance_1 = 0;
    double window = 0; ///< input units
};

HalfHeights halfHeights(const Camera& camera) {
    if (camera.ortho_height > 0) return {0, camera.ortho_height / 2};
    return {std::tan(verticalHalfAngle(camera.fov_deg)), 0};
}

/// From the picture's middle to the centre of pixel (x, y), in half heights of the picture.
Vec3 pixelOffset(const RenderSettings& settings, const Camera& camera, std::uint32_t x, std::uint32_t y) {
    const double aspect = static_cast<double>(settings.width) / settings.height;
    const double across = (2.0 * (x + 0.5) / settings.width - 1.0) * aspect;
    const double upwards = 1.0 - 2.0 * (y + 0.5) / settings.height;
    return across * camera.right + upwards * camera.up;
}

} // namespace

gpu::FrameParams makeFrameParams(const StagedScene& scene, const RenderSettings& settings, const Camera& camera,
                                 std::uint32_t first_row, std::uint32_t rows) {
    const Stage& stage = scene.stage;
    const Vec3 center = 0.5 * (scene.bounds.lo + scene.bounds.hi);
    const double radius = 0.5 * length(scene.bounds.hi - scene.bounds.lo);
    gpu::FrameParams params{};
    const HalfHeights half = halfHeights(camera);
    params.eye = pack(stagePoint(stage, camera.eye), half.at_distance_1);
    params.right = pack(camera.right, static_cast<double>(settings.width) / settings.height);
    params.up = pack(camera.up, half.window / stage.scale);
    params.forward = pack(camera.forward);
    setSky(scene.description.sky.value_or(SkyDescription{}), params);
    params.sky_up = pack(sceneUp(scene.description, settings), (length(camera.eye - center) + radius) / stage.scale);
    params.image = {settings.width, settings.height, first_row, rows};
    params.scene = {static_cast<std::uint32_t>(scene.light_rows.size()), optionBits(settings), scene.shape_count,
                    scene.sky_light};
    params.environment = scene.environment;
    params.film = {settings.width * rows, 0, 0, 0};
    params.mode = {static_cast<std::uint32_t>(settings.integrator), settings.bounces, 0, settings.seed};
    return params;
}

Vec3 centerRayOrigin(const RenderSettings& settings, const Camera& camera, std::uint32_t x, std::uint32_t y) {
    return camera.eye + halfHeights(camera).window * pixelOffset(settings, camera, x, y);
}

Vec3 centerRayDirection(const RenderSettings& settings, const Camera& camera, std::uint32_t x, std::uint32_t y) {
    return normalize(camera.forward + halfHeights(camera).at_distance_1 * pixelOffset(settings, camera, x, y));
}

} // namespace pointrt

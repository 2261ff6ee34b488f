// SPDX-License-Identifier: Apache-2.0
#include "runtime/settings.h"

#include <algorithm>
#include <variant>

#include "runtime/scene_file.h"

namespace pointrt {
namespace {

// From here on noise is hardly seen, and what the filter takes off is detail.
constexpr std::uint32_t kClean = 256;

/// Lights with a size cast soft shadows, which are sampled.
bool isSoft(const LightDescription& light) {
    if (const auto* sun = std::get_if<SunLight>(&light)) return sun->radius_deg > 0;
    return std::holds_alternative<SphereLight>(light) || std::holds_alternative<QuadLight>(light);
}

/// True where samples of a pixel differ by more than its edges.
bool isNoisy(const RenderSettings& settings, const SceneDescription& scene) {
    switch (settings.integrator) {
    case Integrator::kPath:
        return true;
    case Integrator::kPhong:
    case Integrator::kWhitted:
        return std::any_of(scene.lights.begin(), scene.lights.end(), isSoft) ||
               (scene.sky && !scene.sky->image.empty());
    default:
        return false;
    }
}

} // namespace

SceneDescription describeScene(const Options& options) {
    SceneDescription scene;
    if (isSceneFile(options.scene)) {
        scene = readSceneFile(options.scene);
        if (!scene.up) scene.up = Vec3{0, 1, 0}; // not the camera's, which may be tilted
        return scene;
    }
    scene.path = options.scene;
    scene.instances.push_back({options.scene, {}, {}, {}});
    return scene;
}

RenderSettings resolveSettings(const Options& options, const SceneDescription& scene) {
    const SceneChoices& said = options.choices;
    RenderSettings settings = options.render;
    const auto resolve = [](const auto& first, const auto& second, auto& value) {
        value = first ? *first : second.value_or(value);
    };
    resolve(said.integrator, scene.integrator, settings.integrator);
    resolve(said.bounces, scene.bounces, settings.bounces);
    resolve(said.width, scene.width, settings.width);
    resolve(said.height, scene.height, settings.height);
    const bool limited = options.limits.seconds || options.limits.noise;
    resolve(said.spp, limited ? std::optional(kMaxSpp) : scene.spp, settings.spp);
    CameraRequest& camera = settings.camera;
    if (!camera.eye) camera.eye = scene.camera.eye;
    if (!camera.target) camera.target = scene.camera.target;
    if (!camera.up) camera.up = scene.camera.up;
    camera.fov_deg = said.fov_deg.value_or(scene.camera.fov_deg);
    return settings;
}

bool wantsDenoising(const Options& options, const RenderSettings& settings, const SceneDescription& scene,
                    std::uint32_t samples) {
    if (options.denoise != DenoiseChoice::kAuto) return options.denoise == DenoiseChoice::kOn;
    return options.output.ends_with(".png") && samples < kClean && isNoisy(settings, scene);
}

} // namespace pointrt

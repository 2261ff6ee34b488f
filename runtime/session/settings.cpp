// SPDX-License-Identifier: Apache-2.0
#include "runtime/session/settings.h"

#include <algorithm>
#include <variant>

#include "format/base/error.h"
#include "runtime/scene/default_lighting.h"
#include "runtime/scene_file/scene_file.h"

namespace pointrt {
namespace {

/// Lights with a size cast soft shadows, which are sampled.
bool isSoft(const LightDescription& light) {
    if (const auto* sun = std::get_if<SunLight>(&light)) return sun->radius_deg > 0;
    return std::holds_alternative<SphereLight>(light) || std::holds_alternative<QuadLight>(light);
}

const NamedView& viewNamed(const SceneDescription& scene, const std::string& name) {
    std::string known;
    for (const NamedView& view : scene.views) {
        if (view.name == name) return view;
        known += (known.empty() ? "" : ", ") + view.name;
    }
    throw Error{ExitCode::kBadUsage,
                "--view: " + scene.path + " has no view \"" + name + "\"; it has " + (known.empty() ? "none" : known)};
}

void resolveCamera(const SceneChoices& said, const CameraRequest& filed, CameraRequest& camera) {
    if (!camera.eye) camera.eye = filed.eye;
    if (!camera.target) camera.target = filed.target;
    if (!camera.up) camera.up = filed.up;
    camera.fov_deg = said.fov_deg.value_or(filed.fov_deg);
    if (!camera.ortho && !camera.ortho_height && !said.fov_deg) {
        camera.ortho = filed.ortho;
        camera.ortho_height = filed.ortho_height;
    }
}

} // namespace

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
    resolve(said.seed, scene.seed, settings.seed);
    resolve(said.shadows, scene.shadows, settings.shadows);
    resolve(said.caustics, scene.caustics, settings.caustics);
    resolve(said.blend, scene.blend, settings.blend);
    resolve(said.denoise, scene.denoise, settings.denoise);
    resolve(said.exposure, scene.exposure, settings.exposure);
    if (!settings.room) settings.room = scene.room;
    if (!settings.lights) settings.lights = scene.ring_lights;
    if (!settings.reflectivity) settings.reflectivity = scene.reflectivity;
    const NamedView* view = options.view.empty() ? nullptr : &viewNamed(scene, options.view);
    resolveCamera(said, view ? view->camera : scene.camera, settings.camera);
    return settings;
}

SceneDescription describeRun(SceneDescription scene, const RenderSettings& settings, Vec3 staged_for) {
    scene.up = sceneUp(scene, settings);
    scene.camera = settings.camera;
    if (scene.camera.up) scene.camera.up = normalize(*scene.camera.up);
    scene.staged_for.reset();
    if (scene.camera.eye != staged_for) scene.staged_for = staged_for;
    scene.integrator = settings.integrator;
    scene.bounces = settings.bounces;
    scene.spp = settings.spp;
    scene.width = settings.width;
    scene.height = settings.height;
    scene.seed = settings.seed;
    scene.shadows = settings.shadows;
    scene.caustics = settings.caustics;
    scene.blend = settings.blend;
    scene.denoise = settings.denoise;
    scene.exposure = settings.exposure;
    scene.room = settings.room;
    scene.ring_lights = settings.lights;
    scene.reflectivity = settings.reflectivity;
    return scene;
}

bool wantsDenoising(const Options& options, const RenderSettings& settings, const SceneDescription& scene,
                    std::uint32_t samples) {
    if (settings.denoise != DenoiseChoice::kAuto) return settings.denoise == DenoiseChoice::kOn;
    return options.output.ends_with(".png") && samples < kCleanSamplesOfLight && isNoisy(settings, scene);
}

} // namespace pointrt

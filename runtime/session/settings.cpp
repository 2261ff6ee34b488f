// SPDX-License-Identifier: Apache-2.0
#include "runtime/session/settings.h"

#include <algorithm>
#include <filesystem>

#include "format/base/error.h"
#include "runtime/render/default_colors.h"
#include "runtime/scene/added_surroundings.h"
#include "runtime/scene/layers.h"
#include "runtime/scene/render_setting_table.h"
#include "runtime/scene_io/scene_file.h"

namespace pointrt {
namespace {

const NamedView& viewNamed(const SceneDescription& scene, const std::string& name) {
    std::string known;
    for (const NamedView& view : scene.views) {
        if (view.name == name) return view;
        known += (known.empty() ? "" : ", ") + view.name;
    }
    throw Error{ExitCode::kBadUsage, "--view: " + scene.path + " has no view \"" + name + "\"; it has " +
                                         (known.empty() ? "none" : known) + ", and every scene has " +
                                         joinedNames(kStandardViewNames, ", ")};
}

/// Takes each part of the camera from the options if they give it, else from the scene file.
CameraRequest resolveCamera(const Options& options, const CameraRequest& filed) {
    CameraRequest camera = options.camera;
    if (!camera.eye) camera.eye = filed.eye;
    if (!camera.target) camera.target = filed.target;
    if (!camera.up) {
        camera.up = filed.up;
        camera.side = filed.side;
    }
    camera.view = filed.view;
    camera.fov_deg = options.fov_deg.value_or(filed.fov_deg);
    if (!camera.ortho && !camera.ortho_height && !options.fov_deg && !camera.panorama) {
        camera.ortho = filed.ortho;
        camera.ortho_height = filed.ortho_height;
    }
    return camera;
}

/// The scene's camera looking from a standard view: it keeps only the lens.
CameraRequest lookingFrom(StandardView view, const CameraRequest& filed) {
    CameraRequest camera = filed;
    camera.eye.reset();
    camera.target.reset();
    camera.view = view;
    return camera;
}

CameraRequest filedCamera(const Options& options, const SceneDescription& scene) {
    if (options.view.empty()) return scene.camera;
    if (const auto view = standardView(options, scene)) return lookingFrom(*view, scene.camera);
    return viewNamed(scene, options.view).camera;
}

} // namespace

const char* colorOption(const RenderChoices& said) {
    return said.color_map                ? "--color-map"
           : said.color_range            ? "--color-range"
           : said.legend.value_or(false) ? "--legend"
                                         : nullptr;
}

bool leavesColors(const Options& options) {
    return !isSceneFile(options.scene) && !options.choices.color_by && !options.choices.reflectivity;
}

std::optional<StandardView> standardView(const Options& options, const SceneDescription& scene) {
    for (const NamedView& view : scene.views)
        if (view.name == options.view) return std::nullopt;
    for (const auto& [name, view] : kStandardViewNames)
        if (options.view == name) return view;
    return std::nullopt;
}

bool isNoisy(const RenderSettings& settings, const SceneDescription& scene, const StudioSubject& subject) {
    if (subject.only_gaussians && scene.shapes.empty()) return false;
    if (hasTrait(settings.integrator, INTEGRATOR_IS_STOCHASTIC)) return true;
    if (!usesLights(settings.integrator)) return false;
    return std::any_of(scene.lights.begin(), scene.lights.end(),
                       [](const LightDescription& light) { return isVisible(light) && isSoft(light); }) ||
           (scene.sky && !scene.sky->image.empty());
}

SceneDescription describeScene(const Options& options) {
    SceneDescription scene;
    if (isSceneFile(options.scene)) {
        scene = readSceneFile(options.scene);
        if (!options.source.empty()) scene.path = options.source;
        if (!scene.up) scene.up = options.up_axis;
        // other surroundings will replace them
        if (options.choices.room || options.choices.lights) removeSurroundings(scene);
    } else {
        scene.path = options.source.empty() ? options.scene : options.source;
        scene.instances.push_back({options.scene, {}, {}, {}});
        // a file name in the cache means nothing to users
        scene.instances.back().layer.name = std::filesystem::path(options.source).filename().string();
        for (const std::string& path : options.added) scene.instances.push_back({path, {}, {}, {}});
        scene.up = options.up_axis;
    }
    scene.clips.insert(scene.clips.end(), options.clips.begin(), options.clips.end());
    requireFewHalfSpaces(scene.clips);
    scene.filters.insert(scene.filters.end(), options.filters.begin(), options.filters.end());
    hideLayers(scene, options.hidden);
    if (options.sun) addSun(scene, *options.sun);
    return scene;
}

RenderSettings resolveSettings(const Options& options, const SceneDescription& scene) {
    RenderSettings settings;
    RenderChoices filed = scene.render;
    if (options.limits.seconds || options.limits.noise) filed.spp = kMaxSpp;
    applyChoices(filed, settings);
    applyChoices(options.choices, settings);
    if (!leavesColors(options)) requireColored(colorOption(options.choices), settings.color_by);
    settings.first_hits = options.output.ends_with(".exr");
    settings.camera = resolveCamera(options, filedCamera(options, scene));
    return settings;
}

SceneDescription describeRun(SceneDescription scene, const RenderSettings& settings, Vec3 staged_for) {
    scene.up = sceneUp(scene, settings);
    scene.camera = settings.camera;
    if (scene.camera.up) scene.camera.up = normalize(*scene.camera.up);
    scene.staged_for.reset();
    if (scene.camera.eye != staged_for) scene.staged_for = staged_for;
    scene.render = choicesOf(settings);
    return scene;
}

bool wantsDenoising(const Options& options, const RenderSettings& settings, const SceneDescription& scene,
                    std::uint32_t samples, const StudioSubject& subject) {
    if (settings.denoise != DenoiseChoice::kAuto) return settings.denoise == DenoiseChoice::kOn;
    return writesToneMapped(options) && samples < kCleanSamplesOfLight && isNoisy(settings, scene, subject);
}

ToneMapping toneMapping(const SceneDescription& scene, float stops) {
    const std::optional<Background> background = pictureBackground(scene);
    return {stops, !background, background && background->transparent};
}

} // namespace pointrt

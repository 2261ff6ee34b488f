// SPDX-License-Identifier: Apache-2.0
#include "runtime/renderer/loaded_scene.h"

#include "runtime/scene/camera.h"
#include "runtime/scene/default_lighting.h"
#include "runtime/scene/upright.h"

namespace pointrt {
namespace {

// What of loading is done when a stage begins, by the times of scans of half a million to a million splats with an
// index in the file, on a CPU.
constexpr double kFilesShare = 0.0, kRowsShare = 0.15, kProgramsShare = 0.2, kPhotonsShare = 0.6;

Camera framedCamera(const LoadedScene& loaded, const CameraRequest& request) {
    return frameCamera(request, loaded.scene.bounds.lo, loaded.scene.bounds.hi,
                       static_cast<double>(loaded.settings.width) / loaded.settings.height);
}

/// Puts up what stands around the scene, and all tables.
void furnish(Device& device, LoadedScene& loaded, const LoadRequest& request) {
    DeviceScene& scene = loaded.scene;
    CameraRequest staging = request.staging;
    standUpright(scene.description, loaded.settings.camera, staging, {knownUp(scene), request.fallback_up});
    loaded.described = scene.description;
    loaded.camera = framedCamera(loaded, loaded.settings.camera);
    const Camera stage = framedCamera(loaded, staging);
    loaded.staged_for = scene.description.staged_for.value_or(stage.eye);
    addSurroundings(scene.description, loaded.settings, stage, scene.bounds.lo, scene.bounds.hi);
    uploadSceneTables(device, scene, loaded.settings);
}

TracerSize wholeFrames(const Device& device, const RenderSettings& settings) {
    return tracerSizeFor(tilingFor(device, settings.width, settings.height), settings.width);
}

} // namespace

ProgramKinds kindsOf(const DeviceScene& scene, const RenderSettings& settings) {
    return {scene.features, settings.integrator, scene.sky_light != NO_LIGHT, castsCaustics(scene)};
}

LoadedScene::~LoadedScene() {
    destroyBandTracer(device, tracer);
    destroyDeviceScene(device, scene);
}

std::unique_ptr<LoadedScene> loadScene(Device& owner, Device& worker, const LoadRequest& request,
                                       const LoadStage& stage) {
    const auto begin = [&](const char* what, double share) {
        if (stage) stage(what, share);
    };
    auto loaded = std::make_unique<LoadedScene>(owner);
    begin("reading", kFilesShare);
    loaded->settings = request.settings;
    loaded->scene = openScene(worker, request.scene, request.verbose);
    begin("materials and lights", kRowsShare);
    furnish(worker, *loaded, request);
    begin("programs", kProgramsShare);
    const TracerSize size = request.size.value_or(wholeFrames(worker, request.settings));
    createBandTracer(worker, loaded->tracer, loaded->scene, loaded->settings, size.lanes, size.film_pixels);
    loaded->program_kinds = kindsOf(loaded->scene, loaded->settings);
    if (!wantsPhotons(loaded->scene, loaded->settings)) return loaded;
    begin("caustics", kPhotonsShare);
    castPhotons(worker, loaded->tracer, loaded->settings);
    return loaded;
}

} // namespace pointrt

// SPDX-License-Identifier: Apache-2.0
#include "runtime/window/jobs/loaded_scene.h"

#include <utility>

#include "format/base/error.h"
#include "runtime/scene/default_lighting.h"
#include "runtime/session/scene_cameras.h"
#include "runtime/session/settings.h"
#include "runtime/window/live/viewport_renderer.h"

namespace pointrt {
namespace {

// What of loading is done when a stage begins, by the times of scans of half a million to a million splats with an
// index in the file, on a CPU.
constexpr double kFilesShare = 0.0, kRowsShare = 0.15, kProgramsShare = 0.2, kPhotonsShare = 0.6;

ProgramKinds kindsOf(const DeviceScene& scene, const RenderSettings& settings) {
    return {scene.features, settings.integrator, scene.sky_light != NO_LIGHT, castsCaustics(scene)};
}

bool wantsPhotons(const LoadedScene& loaded) {
    return castsCaustics(loaded.scene) && showsLight(loaded.settings.integrator);
}

void begin(JobControl& control, const char* stage, double share) {
    control.leaveIfCancelled();
    control.say(stage);
    control.setShare(share);
}

/// Leaves the photons there were out.
void forgetPhotons(LoadedScene& loaded) { loaded.tracer.caustics.frame.count.x = 0; }

/// Photons for the scene as it is now.
void castPhotons(Device& device, LoadedScene& loaded) {
    BandTracer& tracer = loaded.tracer;
    CausticMap map =
        wantsPhotons(loaded) ? buildCaustics(device, loaded.scene, tracer.programs, kPhotons) : emptyCaustics(device);
    destroyCaustics(device, tracer.caustics);
    tracer.caustics = std::exchange(map, {});
    rebind(device, tracer);
}

/// Whether the scene has become one for other programs.
bool rebuildPrograms(Device& device, LoadedScene& loaded) {
    const ProgramKinds kinds = kindsOf(loaded.scene, loaded.settings);
    if (kinds == loaded.program_kinds) return false;
    Programs programs = createPrograms(device, loaded.scene, loaded.settings);
    destroyPrograms(device, loaded.tracer.programs);
    loaded.tracer.programs = std::exchange(programs, {});
    loaded.program_kinds = kinds;
    return true;
}

void noteSettings(LoadedScene& loaded, const RenderSettings& settings) {
    loaded.settings = settings;
    loaded.tracer.shadows = settings.shadows;
}

void furnish(Device& device, LoadedScene& loaded, const SceneDescription& description, const RenderSettings& settings) {
    if (!standsAlike(loaded.scene.description, description))
        throw Error{ExitCode::kBadInput, description.path + ": other scans, or other places, take loading anew"};
    SceneDescription before = std::exchange(loaded.scene.description, description);
    try {
        uploadSceneTables(device, loaded.scene, settings);
    } catch (...) {
        loaded.scene.description = std::move(before);
        throw;
    }
    noteSettings(loaded, settings);
}

} // namespace

LoadedScene::~LoadedScene() {
    destroyBandTracer(device, tracer);
    destroyDeviceScene(device, scene);
}

std::unique_ptr<LoadedScene> loadFromFile(Device& owner, Device& worker, const Options& options, JobControl& control) {
    auto loaded = std::make_unique<LoadedScene>(owner);
    DeviceScene& scene = loaded->scene;
    begin(control, "reading", kFilesShare);
    loaded->described = describeScene(options);
    loaded->settings = resolveSettings(options, loaded->described);
    scene = openScene(worker, loaded->described, options.verbose);
    begin(control, "materials and lights", kRowsShare);
    loaded->camera = framedCamera(scene, loaded->settings);
    loaded->staged_for = scene.description.staged_for.value_or(stagingCamera(scene, options).eye);
    scene.description = withSurroundings(*loaded, loaded->settings);
    uploadSceneTables(worker, scene, loaded->settings);
    begin(control, "programs", kProgramsShare);
    createBandTracer(worker, loaded->tracer, scene, loaded->settings, kSliceLanes, 1, 0);
    loaded->program_kinds = kindsOf(scene, loaded->settings);
    if (wantsPhotons(*loaded)) {
        begin(control, "caustics", kPhotonsShare);
        castPhotons(worker, *loaded);
    }
    control.leaveIfCancelled();
    return loaded;
}

SceneDescription withSurroundings(const LoadedScene& loaded, const RenderSettings& settings) {
    SceneDescription scene = loaded.described;
    Camera camera = loaded.camera;
    camera.eye = loaded.staged_for;
    addSurroundings(scene, settings, camera, loaded.scene.bounds.lo, loaded.scene.bounds.hi);
    return scene;
}

void refurnish(Device& device, LoadedScene& loaded, const SceneDescription& description, const RenderSettings& settings,
               JobControl& control) {
    loaded.lacks_photons = false; // nor is it to be tried again where the user does not want to wait
    control.say("materials and lights");
    furnish(device, loaded, description, settings);
    forgetPhotons(loaded);
    // not to be cancelled: rows, programs and bindings belong together
    control.say("programs");
    if (rebuildPrograms(device, loaded)) control.setShare(kPhotonsShare);
    rebind(device, loaded.tracer);
    begin(control, "caustics", kPhotonsShare);
    castPhotons(device, loaded);
}

bool refurnishNow(Device& device, LoadedScene& loaded, const SceneDescription& description,
                  const RenderSettings& settings) {
    if (settings.integrator != loaded.program_kinds.integrator) return false;
    if (!furnishAlike(device, loaded.scene, description, settings)) return false;
    noteSettings(loaded, settings);
    forgetPhotons(loaded);
    loaded.lacks_photons = wantsPhotons(loaded);
    rebind(device, loaded.tracer);
    return true;
}

} // namespace pointrt

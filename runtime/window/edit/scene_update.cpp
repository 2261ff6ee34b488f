// SPDX-License-Identifier: Apache-2.0
#include "runtime/window/edit/scene_update.h"

#include <utility>

#include "format/base/error.h"

namespace pointrt {
namespace {

/// Progress when the programs are built and only the photons remain.
constexpr double kPhotonsShare = 0.6;

/// Rebuilds the programs if the scene needs others.
bool rebuildPrograms(Device& device, LoadedScene& loaded) {
    const ProgramKinds kinds = kindsOf(loaded.scene, loaded.settings);
    if (kinds == loaded.program_kinds) return false;
    Programs programs = createPrograms(device, loaded.scene, loaded.settings, {});
    destroyPrograms(device, loaded.tracer.programs);
    loaded.tracer.programs = std::exchange(programs, {});
    loaded.program_kinds = kinds;
    return true;
}

void applySettings(LoadedScene& loaded, const RenderSettings& settings) {
    loaded.settings = settings;
    loaded.tracer.shadows = settings.shadows;
}

void uploadScene(Device& device, LoadedScene& loaded, const SceneDescription& description,
                 const RenderSettings& settings) {
    if (!haveSameFiles(loaded.scene.description, description))
        throw Error{ExitCode::kBadInput,
                    description.path + ": its scans differ from those that are open; reload the scene"};
    const bool moves = !haveSamePlacements(loaded.scene.description, description);
    SceneDescription old = loaded.scene.description;
    const auto take = [&](const SceneDescription& taken) {
        if (moves)
            placeInstances(device, loaded.scene, taken);
        else
            loaded.scene.description = taken;
    };
    try {
        take(description);
        uploadSceneTables(device, loaded.scene, settings);
    } catch (...) {
        take(old);
        throw;
    }
    applySettings(loaded, settings);
}

} // namespace

void updateScene(Device& device, LoadedScene& loaded, const SceneDescription& description,
                 const RenderSettings& settings, JobControl& control) {
    loaded.lacks_photons = false; // do not retry if the user cancels
    control.setDetail("materials and lights");
    uploadScene(device, loaded, description, settings);
    dropPhotons(loaded.tracer);
    // not cancellable: tables, programs and bindings must match
    control.setDetail("programs");
    if (rebuildPrograms(device, loaded)) control.setProgress(kPhotonsShare);
    rebind(device, loaded.tracer);
    control.throwIfCancelled();
    control.setDetail("caustics");
    control.setProgress(kPhotonsShare);
    tracePhotons(device, loaded.tracer, loaded.settings);
}

void updateSceneTables(Device& device, LoadedScene& loaded, const SceneDescription& description,
                       const RenderSettings& settings, RequiredUpdate update) {
    if (update.kind == UpdateKind::kPlacements) {
        placeInstances(device, loaded.scene, description);
        update.rows = makeSceneRows(loaded.scene, description, settings);
    }
    uploadSceneRows(device, loaded.scene, description, settings, std::move(update.rows));
    applySettings(loaded, settings);
    dropPhotons(loaded.tracer);
    loaded.lacks_photons = needsPhotons(loaded.scene, loaded.settings);
    rebind(device, loaded.tracer);
}

} // namespace pointrt

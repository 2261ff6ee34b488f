// SPDX-License-Identifier: Apache-2.0
#include "runtime/window/edit/refurnish.h"

#include <utility>

#include "format/base/error.h"

namespace pointrt {
namespace {

/// What of it is done where photons are to be cast, after programs were built.
constexpr double kPhotonsShare = 0.6;

/// Whether the scene has become one for other programs.
bool rebuildPrograms(Device& device, LoadedScene& loaded) {
    const ProgramKinds kinds = kindsOf(loaded.scene, loaded.settings);
    if (kinds == loaded.program_kinds) return false;
    Programs programs = createPrograms(device, loaded.scene, loaded.settings, {});
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

void refurnish(Device& device, LoadedScene& loaded, const SceneDescription& description, const RenderSettings& settings,
               JobControl& control) {
    loaded.lacks_photons = false; // nor is it to be tried again where the user does not want to wait
    control.say("materials and lights");
    furnish(device, loaded, description, settings);
    forgetPhotons(loaded.tracer);
    // not to be cancelled: rows, programs and bindings belong together
    control.say("programs");
    if (rebuildPrograms(device, loaded)) control.setShare(kPhotonsShare);
    rebind(device, loaded.tracer);
    control.leaveIfCancelled();
    control.say("caustics");
    control.setShare(kPhotonsShare);
    castPhotons(device, loaded.tracer, loaded.settings);
}

void refurnishNow(Device& device, LoadedScene& loaded, const SceneDescription& description,
                  const RenderSettings& settings, SceneRows rows) {
    uploadSceneRows(device, loaded.scene, description, settings, std::move(rows));
    noteSettings(loaded, settings);
    forgetPhotons(loaded.tracer);
    loaded.lacks_photons = wantsPhotons(loaded.scene, loaded.settings);
    rebind(device, loaded.tracer);
}

} // namespace pointrt

// SPDX-License-Identifier: Apache-2.0
#include "runtime/window/edit/rework.h"

#include "runtime/device_scene/scene_rows.h"

namespace pointrt {

Rework reworkFor(const DeviceScene& scene, Integrator integrator, const SceneDescription& description,
                 const RenderSettings& settings) {
    if (!standsAlike(scene.description, description)) return Rework::kReload;
    const std::string sky_image = description.sky ? description.sky->image : std::string();
    if (settings.integrator != integrator || sky_image != scene.sky_image) return Rework::kPrograms;
    const SceneRows rows = makeSceneRows(scene, description, settings);
    return rows.features == scene.features ? Rework::kTables : Rework::kPrograms;
}

EditStep nextStep(Rework rework, bool dragging, bool lacks_photons) {
    if (rework == Rework::kTables) return EditStep::kUpload;
    if (dragging || (rework == Rework::kNothing && !lacks_photons)) return EditStep::kNothing;
    return EditStep::kRelight; // where it takes a reload, that says so
}

} // namespace pointrt

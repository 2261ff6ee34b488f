// SPDX-License-Identifier: Apache-2.0
#include "runtime/window/edit/rework.h"

#include <utility>

namespace pointrt {

Rework reworkFor(const DeviceScene& scene, Integrator integrator, const SceneDescription& description,
                 const RenderSettings& settings) {
    if (!standsAlike(scene.description, description)) return {ReworkKind::kReload, {}};
    const std::string sky_image = description.sky ? description.sky->image : std::string();
    if (settings.integrator != integrator || sky_image != scene.sky_image) return {ReworkKind::kPrograms, {}};
    if (paintRequest(description, settings) != scene.paint.request) return {ReworkKind::kPrograms, {}};
    SceneRows rows = makeSceneRows(scene, description, settings);
    const bool others = shapeKinds(rows.shapes) != shapeKinds(scene.shape_rows);
    if (others || rows.features != scene.features) return {ReworkKind::kPrograms, {}};
    return {ReworkKind::kTables, std::move(rows)};
}

EditStep nextStep(ReworkKind rework, bool dragging, bool lacks_photons) {
    if (rework == ReworkKind::kTables) return EditStep::kUpload;
    if (dragging || (rework == ReworkKind::kNothing && !lacks_photons)) return EditStep::kNothing;
    return EditStep::kRelight; // where it takes a reload, that says so
}

} // namespace pointrt

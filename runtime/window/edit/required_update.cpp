// SPDX-License-Identifier: Apache-2.0
#include "runtime/window/edit/required_update.h"

#include <utility>

namespace pointrt {

RequiredUpdate requiredUpdate(const DeviceScene& scene, Integrator integrator, const SceneDescription& description,
                              const RenderSettings& settings) {
    if (!haveSameFiles(scene.description, description)) return {UpdateKind::kReload, {}};
    const bool moves = !haveSamePlacements(scene.description, description);
    // colours by height must be recomputed, and sets need other tiles
    if (moves && (paintsScans(description, settings) || !scene.sets.empty())) return {UpdateKind::kPrograms, {}};
    const std::string sky_image = description.sky ? description.sky->image : std::string();
    if (settings.integrator != integrator || sky_image != scene.sky_image) return {UpdateKind::kPrograms, {}};
    if (paintRequest(description, settings) != scene.paint.request) return {UpdateKind::kPrograms, {}};
    SceneRows rows = makeSceneRows(scene, description, settings);
    const bool others = shapeKinds(rows.shapes) != shapeKinds(scene.shape_rows);
    if (others || rows.features != scene.features) return {UpdateKind::kPrograms, {}};
    return {moves ? UpdateKind::kPlacements : UpdateKind::kTables, std::move(rows)};
}

UpdateStep nextUpdateStep(UpdateKind kind, bool dragging, bool lacks_photons) {
    if (kind == UpdateKind::kTables || kind == UpdateKind::kPlacements) return UpdateStep::kUpload;
    if (dragging || (kind == UpdateKind::kNothing && !lacks_photons)) return UpdateStep::kNothing;
    return UpdateStep::kSceneUpdate; // with kReload, the job fails with a message
}

} // namespace pointrt

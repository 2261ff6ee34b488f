// SPDX-License-Identifier: Apache-2.0
// Which parts of the scene on the device an edit invalidates.
#pragma once

#include <cstdint>

#include "runtime/device_scene/device_scene.h"
#include "runtime/device_scene/scene_rows.h"

namespace pointrt {

/// In order of cost.
enum class UpdateKind : std::uint8_t {
    kNothing,
    kTables,     ///< tables of materials, shapes and lights: a few milliseconds
    kPlacements, ///< tables, and the places of scans: just as fast
    kPrograms,   ///< also shader programs, the sky's image or splat colours: needs a job
    kReload      ///< other scans: the scene must be reloaded
};

struct RequiredUpdate {
    UpdateKind kind = UpdateKind::kNothing;
    SceneRows rows; ///< for kTables
};

/// The update that makes scene, with its programs for this integrator, match description and settings. Throws Error
/// kBadInput as makeSceneRows does.
RequiredUpdate requiredUpdate(const DeviceScene& scene, Integrator integrator, const SceneDescription& description,
                              const RenderSettings& settings);

/// What to do in this frame.
enum class UpdateStep : std::uint8_t {
    kNothing,     ///< nothing to do, or wait until the user releases the mouse
    kUpload,      ///< update the tables now
    kSceneUpdate, ///< start the job that updates everything
};

/// dragging: the edit continues and must not wait for a job. lacks_photons: tables were uploaded without new photons.
UpdateStep nextUpdateStep(UpdateKind kind, bool dragging, bool lacks_photons);

} // namespace pointrt

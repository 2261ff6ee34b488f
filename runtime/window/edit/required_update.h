// SPDX-License-Identifier: Apache-2.0
// What an edit makes necessary.
#pragma once

#include <cstdint>

#include "runtime/device_scene/device_scene.h"
#include "runtime/device_scene/scene_rows.h"

namespace pointrt {

/// The cheapest that will do comes first.
enum class UpdateKind : std::uint8_t {
    kNothing,
    kTables,   ///< rows of materials, shapes and lights: a few milliseconds
    kPrograms, ///< other programs, another picture of the sky or splats painted anew as well: a job's
    kReload    ///< other scans, or other places: nothing that is there will do
};

struct RequiredUpdate {
    UpdateKind kind = UpdateKind::kNothing;
    SceneRows rows; ///< where they are all it takes: kTables
};

/// What it takes until scene, for which programs of this integrator were built, is as description and settings say.
/// Throws Error kBadInput as makeSceneRows does.
RequiredUpdate requiredUpdate(const DeviceScene& scene, Integrator integrator, const SceneDescription& description,
                              const RenderSettings& settings);

/// What is to be done about it in this frame.
enum class UpdateStep : std::uint8_t {
    kNothing,     ///< it is done, or must wait until the user has let go
    kUpload,      ///< the tables
    kSceneUpdate, ///< the job that makes all of it
};

/// dragging: more of the same edit is to come, and must not wait for a job. lacks_photons: tables were uploaded
/// without.
UpdateStep nextUpdateStep(UpdateKind rework, bool dragging, bool lacks_photons);

} // namespace pointrt

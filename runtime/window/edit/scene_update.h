// SPDX-License-Identifier: Apache-2.0
// Updates a loaded scene after edits of lights, materials and surroundings.
#pragma once

#include "runtime/render/loaded_scene.h"
#include "runtime/window/edit/job.h"
#include "runtime/window/edit/required_update.h"

namespace pointrt {

/// Makes loaded match description (with surroundings) and settings: updates tables, and if needed programs and photons.
/// Needs exclusive access to loaded; pictures of it must start over. Throws Error kBadInput and changes nothing if a
/// sky image cannot be read or description has other scans. If cancelled, the scene has no photons until the next edit.
void updateScene(Device& device, LoadedScene& loaded, const SceneDescription& description,
                 const RenderSettings& settings, JobControl& control);

/// The fast path for UpdateKind::kTables and kPlacements: tables only, without photons, in a few milliseconds.
void updateSceneTables(Device& device, LoadedScene& loaded, const SceneDescription& description,
                       const RenderSettings& settings, RequiredUpdate update);

} // namespace pointrt

// SPDX-License-Identifier: Apache-2.0
// A loaded scene lit anew while it is looked at: other lights, materials, surroundings.
#pragma once

#include "runtime/device_scene/scene_rows.h"
#include "runtime/render/loaded_scene.h"
#include "runtime/window/edit/job.h"

namespace pointrt {

/// Furnishes loaded for description, which has its surroundings, and settings: rows, and, where it takes others,
/// programs and photons. Nobody else may use loaded meanwhile; pictures of it start over. Throws Error kBadInput where
/// a picture of the sky cannot be read or description names other files or places, with nothing changed. Cancelled, it
/// leaves photons out, for good, and nothing else.
void updateScene(Device& device, LoadedScene& loaded, const SceneDescription& description,
                 const RenderSettings& settings, JobControl& control);

/// The same in a few milliseconds and without photons, where rows are all that is new: see Rework::kTables.
void updateSceneTables(Device& device, LoadedScene& loaded, const SceneDescription& description,
                       const RenderSettings& settings, SceneRows rows);

} // namespace pointrt

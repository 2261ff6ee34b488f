// SPDX-License-Identifier: Apache-2.0
// The surroundings that a saved scene contains: distinguishing them from the scene's own parts, and removing them.
#pragma once

#include <cstdint>

#include "runtime/scene/scene_description.h"

namespace pointrt {

/// The word for the studio in [surroundings]; --room has no word for it.
inline constexpr const char* kStudioWord = "studio";

/// Whether a shape or an instance uses a material.
bool usesMaterial(const SceneDescription& scene, std::uint32_t material);

/// Moves the materials that only surroundings use to the end of the list.
void moveSurroundingMaterialsLast(SceneDescription& scene);

/// Removes the surroundings, if any: their shapes, the materials of those shapes at the end of the list, the lights and
/// sky if they belong to the surroundings, and the choice of room and lamps.
void removeSurroundings(SceneDescription& scene);

} // namespace pointrt

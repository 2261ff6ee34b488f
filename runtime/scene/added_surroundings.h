// SPDX-License-Identifier: Apache-2.0
// The surroundings that a saved scene contains: told apart from its own parts, and taken out again.
#pragma once

#include <cstdint>

#include "runtime/scene/scene_description.h"

namespace pointrt {

/// The word for the studio in [surroundings]; --room has no name for it.
inline constexpr const char* kStudioWord = "studio";

/// Whether a shape or an instance uses a material.
bool usesMaterial(const SceneDescription& scene, std::uint32_t material);

/// Moves the materials that only shapes of the surroundings use behind all others.
void moveSurroundingMaterialsLast(SceneDescription& scene);

/// Takes out the shapes and, if they belong to it, the lights and the sky of scene.surroundings, with the materials of
/// those shapes at the end of the list; also the choice of room and lamps. Does nothing without surroundings.
void removeSurroundings(SceneDescription& scene);

} // namespace pointrt

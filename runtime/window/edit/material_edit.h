// SPDX-License-Identifier: Apache-2.0
// Editing the materials of scans without changing materials that other objects use.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>

#include "runtime/scene/scene_description.h"

namespace pointrt {

/// Instances [first, first + count), which must exist; count above 0.
struct InstanceRange {
    std::size_t first = 0, count = 1;
};

/// True if material is used by an instance outside range, by a part of any instance, or by a shape.
bool usedBeside(const SceneDescription& scene, InstanceRange range, std::uint32_t material);

/// True if a shape uses material.
bool usedByShapes(const SceneDescription& scene, std::uint32_t material);

/// True if a material of the scene has this name.
bool isMaterialNamed(const SceneDescription& scene, const std::string& name);

/// A default material of this kind, with the scan's own colours if the kind has colours.
MaterialDescription freshMaterial(MaterialKind kind);

/// Assigns the instances a material of this kind, not shared with other instances or shapes. Without a kind, they get
/// the materials of their files again. Modifies their current material if nothing else uses it, otherwise adds one.
/// Returns false and changes nothing if the scene has the maximum number of materials.
bool setScanMaterial(SceneDescription& scene, InstanceRange range, std::optional<MaterialKind> kind);

} // namespace pointrt

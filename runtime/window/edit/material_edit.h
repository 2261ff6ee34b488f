// SPDX-License-Identifier: Apache-2.0
// Materials of scans as the panel changes them: what others use stays as it is.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>

#include "runtime/scene/scene_description.h"

namespace pointrt {

/// The instances first to first + count, which must be there; count above 0.
struct InstanceRange {
    std::size_t first = 0, count = 1;
};

/// True where an instance outside of range, a part of an instance or a shape uses material.
bool usedBeside(const SceneDescription& scene, InstanceRange range, std::uint32_t material);

/// True where any shape uses material.
bool usedByShapes(const SceneDescription& scene, std::uint32_t material);

/// A material of this kind that keeps the scan's colours, where the kind has colours.
MaterialDescription freshMaterial(MaterialKind kind);

/// Gives the instances a material of this kind that nobody else uses, or without a kind what their files say; one that
/// they alone had becomes it, another is left alone. False, and nothing is done, when scene files hold no more
/// materials.
bool setScanMaterial(SceneDescription& scene, InstanceRange range, std::optional<MaterialKind> kind);

} // namespace pointrt

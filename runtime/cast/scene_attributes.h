// SPDX-License-Identifier: Apache-2.0
// Attributes, colours and units of a ray-cast scene's files and tile sets.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "pointrt/trace.hpp"
#include "runtime/cast/instance_residency.h"

namespace pointrt {

/// The attributes that all instances have, with the same type.
std::vector<SceneAttribute> sceneAttributes(const InstanceResidency& resident);

/// Hits as castRays returns them.
struct HitIds {
    std::span<const std::uint32_t> splats, instances;
    std::span<const std::uint32_t> tiles; ///< may be empty if the scene has no sets
};

/// Implements TraceScene::readAttribute. Reads the resident tiles that were hit, then loads the others.
void gatherAttribute(InstanceResidency& resident, const std::string& name, const HitIds& ids,
                     std::span<std::byte> values);

/// Implements TraceScene::readColors. Loads tiles in the same way.
void gatherColors(InstanceResidency& resident, const HitIds& ids, std::span<std::uint8_t> colors);

/// Implements TraceScene::metresPerUnit.
double metresPerUnit(const InstanceResidency& resident);

} // namespace pointrt

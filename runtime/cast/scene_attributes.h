// SPDX-License-Identifier: Apache-2.0
// What a scene's files and sets say of their splats, and of themselves, besides where they lie.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "pointrt/trace.hpp"
#include "runtime/cast/resident_targets.h"

namespace pointrt {

/// Those that all instances have alike.
std::vector<SceneAttribute> sceneAttributes(const ResidentTargets& resident);

/// Hits, as castRays tells them.
struct HitIds {
    std::span<const std::uint32_t> splats, instances;
    std::span<const std::uint32_t> tiles; ///< empty where the scene has no sets
};

/// As TraceScene::readAttribute. Brings the tiles that were hit, those first that are there.
void gatherAttribute(ResidentTargets& resident, const std::string& name, const HitIds& ids,
                     std::span<std::byte> values);

/// As TraceScene::readColors. Brings tiles likewise.
void gatherColors(ResidentTargets& resident, const HitIds& ids, std::span<std::uint8_t> colors);

/// As TraceScene::metresPerUnit.
double metresPerUnit(const ResidentTargets& resident);

} // namespace pointrt

// SPDX-License-Identifier: Apache-2.0
// What a scene's files say of their splats, and of themselves, besides where they lie.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "pointrt/trace.hpp"
#include "runtime/device_scene/device_scene.h"

namespace pointrt {

/// Those that the files of all instances have alike.
std::vector<SceneAttribute> sceneAttributes(const DeviceScene& scene);

/// As TraceScene::readAttribute.
void gatherAttribute(const DeviceScene& scene, const std::string& name, std::span<const std::uint32_t> splats,
                     std::span<const std::uint32_t> instances, std::span<std::byte> values);

/// As TraceScene::readColors.
void gatherColors(const DeviceScene& scene, std::span<const std::uint32_t> splats,
                  std::span<const std::uint32_t> instances, std::span<std::uint8_t> colors);

/// As TraceScene::metresPerUnit.
double metresPerUnit(const DeviceScene& scene);

} // namespace pointrt

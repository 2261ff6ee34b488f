// SPDX-License-Identifier: Apache-2.0
// How rays find what they hit.
#pragma once

#include <array>
#include <cstdint>

#include "runtime/util/names.h"

namespace pointrt {

enum class Traversal : std::uint8_t {
    kWalk,     ///< by walking through the cells in the shader, on any device
    kHardware, ///< by the device's ray queries (VK_KHR_ray_query) over boxes of cells
    kAuto      ///< by ray queries on GPUs that have them
};
inline constexpr std::array kTraversalNames = {Name{"walk", Traversal::kWalk}, Name{"hardware", Traversal::kHardware},
                                               Name{"auto", Traversal::kAuto}};

} // namespace pointrt

// SPDX-License-Identifier: Apache-2.0
// Memory of a device that this process may still use.
#pragma once

#include <cstdint>

#include "runtime/gpu/device.h"

namespace pointrt {

/// Bytes left in the device's largest heap of its own: as VK_EXT_memory_budget reports, which counts other programs,
/// else the heap's size.
std::uint64_t availableDeviceMemory(const Device& device);

} // namespace pointrt

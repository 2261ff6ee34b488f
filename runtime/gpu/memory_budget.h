// SPDX-License-Identifier: Apache-2.0
// Memory of a device that this process may still use.
#pragma once

#include <cstdint>

#include "runtime/gpu/device.h"

namespace pointrt {

/// Bytes free in the largest device-local heap, after other programs, by VK_EXT_memory_budget; without it, the heap's
/// size.
std::uint64_t availableDeviceMemory(const Device& device);

} // namespace pointrt

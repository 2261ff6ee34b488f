// SPDX-License-Identifier: Apache-2.0
// Which of a device's memory types a buffer lives in.
#pragma once

#include <cstdint>
#include <optional>

#include "runtime/gpu/vulkan.h"

namespace pointrt {

/// How a buffer is used.
enum class MemoryHome {
    kDevice,  ///< the device; the host may write and read it in place only where that is as fast as its own memory
    kUpload,  ///< the host writes it, the device reads it: mapped and coherent, but slow for the host to read
    kReadback ///< the device writes it, the host reads it: mapped and cached, but perhaps not coherent
};

/// The type for a buffer among allowed (a bit mask), or none if no type will do.
/// @param unified the device shares the host's memory
std::optional<std::uint32_t> chooseMemoryType(const VkPhysicalDeviceMemoryProperties& memory, std::uint32_t allowed,
                                              MemoryHome home, bool unified);

/// Whether the host maps memory with these properties for this home. Device memory that is not cached stays unmapped:
/// the host would read it over the bus or uncached, a hundred times slower than a copy on the device.
bool isMapped(VkMemoryPropertyFlags properties, MemoryHome home, bool unified);

} // namespace pointrt

// SPDX-License-Identifier: Apache-2.0
// How long the device works on commands, by its own clock.
#pragma once

#include <optional>

#include "runtime/gpu/device.h"

namespace pointrt {

/// Times one stretch of commands at a time. Free it with destroyDeviceClock before the device.
struct DeviceClock {
    VkQueryPool pool = VK_NULL_HANDLE; ///< null where the queue keeps no time
    double tick_ms = 0;
    std::uint64_t mask = 0; ///< the bits of a moment that count
};

DeviceClock createDeviceClock(Device& device);
void destroyDeviceClock(Device& device, DeviceClock& clock);

/// Before and after the stretch, in one command buffer.
void recordClockStart(VkCommandBuffer commands, const DeviceClock& clock);
void recordClockEnd(VkCommandBuffer commands, const DeviceClock& clock);
/// Milliseconds between the two, once the commands are done; nothing where the queue keeps no time.
std::optional<double> clockedMilliseconds(Device& device, const DeviceClock& clock);

} // namespace pointrt

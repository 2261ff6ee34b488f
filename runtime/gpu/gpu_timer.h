// SPDX-License-Identifier: Apache-2.0
// Device time of commands, by timestamp queries.
#pragma once

#include <optional>

#include "runtime/gpu/device.h"

namespace pointrt {

/// Times one range of commands at a time. Free it with destroyGpuTimer before the device.
struct GpuTimer {
    VkQueryPool pool = VK_NULL_HANDLE; ///< null if the queue has no timestamps
    double tick_ms = 0;
    std::uint64_t mask = 0; ///< valid bits of a timestamp
};

GpuTimer createGpuTimer(Device& device);
void destroyGpuTimer(Device& device, GpuTimer& timer);

/// Record the start and end of the range, in one command buffer.
void recordTimerStart(VkCommandBuffer commands, const GpuTimer& timer);
void recordTimerEnd(VkCommandBuffer commands, const GpuTimer& timer);
/// Milliseconds between start and end, after the commands are done; nullopt if the queue has no timestamps.
std::optional<double> elapsedMilliseconds(Device& device, const GpuTimer& timer);

} // namespace pointrt

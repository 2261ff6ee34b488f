// SPDX-License-Identifier: Apache-2.0
// Device time of commands, by timestamp queries.
#pragma once

#include <cstdint>
#include <optional>

#include "runtime/gpu/device.h"

namespace pointrt {

/// Times a number of ranges of commands at once. Free it with destroyGpuTimer before the device.
struct GpuTimer {
    VkQueryPool pool = VK_NULL_HANDLE; ///< null if the queue has no timestamps
    std::uint32_t ranges = 0;
    double tick_ms = 0;
    std::uint64_t mask = 0; ///< valid bits of a timestamp
};

GpuTimer createGpuTimer(Device& device, std::uint32_t ranges = 1);
void destroyGpuTimer(Device& device, GpuTimer& timer);

/// Record the start and the end of a range in one command buffer. Each timestamp is taken when all earlier commands are
/// done.
void recordTimerStart(VkCommandBuffer commands, const GpuTimer& timer, std::uint32_t range = 0);
void recordTimerEnd(VkCommandBuffer commands, const GpuTimer& timer, std::uint32_t range = 0);
/// Milliseconds between start and end of a range, after the commands are done; nullopt if the queue has no timestamps.
std::optional<double> elapsedMilliseconds(const Device& device, const GpuTimer& timer, std::uint32_t range = 0);

} // namespace pointrt

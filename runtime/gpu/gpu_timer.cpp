// SPDX-License-Identifier: Apache-2.0
#include "runtime/gpu/gpu_timer.h"

#include <array>
#include <vector>

namespace pointrt {
namespace {

constexpr std::uint32_t kStart = 0, kEnd = 1, kTimestamps = 2; // of a range

std::uint32_t query(std::uint32_t range, std::uint32_t which) { return range * kTimestamps + which; }

std::uint32_t validBits(const Device& device) {
    std::uint32_t count = 0;
    vkGetPhysicalDeviceQueueFamilyProperties(device.physical, &count, nullptr);
    std::vector<VkQueueFamilyProperties> families(count);
    vkGetPhysicalDeviceQueueFamilyProperties(device.physical, &count, families.data());
    return families.at(device.queue_family).timestampValidBits;
}

} // namespace

GpuTimer createGpuTimer(Device& device, std::uint32_t ranges) {
    GpuTimer timer;
    const std::uint32_t bits = validBits(device);
    if (bits == 0) return timer;
    timer.ranges = ranges;
    timer.mask = ~std::uint64_t{0} >> (64 - bits);
    timer.tick_ms = 1e-6 * static_cast<double>(device.limits.timestampPeriod); // nanoseconds
    VkQueryPoolCreateInfo info{VK_STRUCTURE_TYPE_QUERY_POOL_CREATE_INFO};
    info.queryType = VK_QUERY_TYPE_TIMESTAMP;
    info.queryCount = ranges * kTimestamps;
    check(vkCreateQueryPool(device.handle, &info, nullptr, &timer.pool), "create a query pool");
    return timer;
}

void destroyGpuTimer(Device& device, GpuTimer& timer) {
    if (timer.pool) vkDestroyQueryPool(device.handle, timer.pool, nullptr);
    timer = {};
}

void recordTimerStart(VkCommandBuffer commands, const GpuTimer& timer, std::uint32_t range) {
    if (!timer.pool) return;
    vkCmdResetQueryPool(commands, timer.pool, query(range, kStart), kTimestamps);
    vkCmdWriteTimestamp(commands, VK_PIPELINE_STAGE_BOTTOM_OF_PIPE_BIT, timer.pool, query(range, kStart));
}

void recordTimerEnd(VkCommandBuffer commands, const GpuTimer& timer, std::uint32_t range) {
    if (timer.pool) vkCmdWriteTimestamp(commands, VK_PIPELINE_STAGE_BOTTOM_OF_PIPE_BIT, timer.pool, query(range, kEnd));
}

std::optional<double> elapsedMilliseconds(const Device& device, const GpuTimer& timer, std::uint32_t range) {
    if (!timer.pool) return {};
    std::array<std::uint64_t, kTimestamps> ticks{};
    check(vkGetQueryPoolResults(device.handle, timer.pool, query(range, kStart), kTimestamps, sizeof ticks,
                                ticks.data(), sizeof ticks[0], VK_QUERY_RESULT_64_BIT | VK_QUERY_RESULT_WAIT_BIT),
          "read the device's timestamps");
    return static_cast<double>((ticks[kEnd] - ticks[kStart]) & timer.mask) * timer.tick_ms;
}

} // namespace pointrt

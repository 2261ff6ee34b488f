// SPDX-License-Identifier: Apache-2.0
#include "runtime/gpu/device_clock.h"

#include <array>
#include <vector>

namespace pointrt {
namespace {

constexpr std::uint32_t kStart = 0, kEnd = 1, kMoments = 2;

std::uint32_t validBits(const Device& device) {
    std::uint32_t count = 0;
    vkGetPhysicalDeviceQueueFamilyProperties(device.physical, &count, nullptr);
    std::vector<VkQueueFamilyProperties> families(count);
    vkGetPhysicalDeviceQueueFamilyProperties(device.physical, &count, families.data());
    return families.at(device.queue_family).timestampValidBits;
}

} // namespace

DeviceClock createDeviceClock(Device& device) {
    DeviceClock clock;
    const std::uint32_t bits = validBits(device);
    if (bits == 0) return clock;
    clock.mask = ~std::uint64_t{0} >> (64 - bits);
    clock.tick_ms = 1e-6 * static_cast<double>(device.limits.timestampPeriod); // of nanoseconds
    VkQueryPoolCreateInfo info{VK_STRUCTURE_TYPE_QUERY_POOL_CREATE_INFO};
    info.queryType = VK_QUERY_TYPE_TIMESTAMP;
    info.queryCount = kMoments;
    check(vkCreateQueryPool(device.handle, &info, nullptr, &clock.pool), "create a query pool");
    return clock;
}

void destroyDeviceClock(Device& device, DeviceClock& clock) {
    if (clock.pool) vkDestroyQueryPool(device.handle, clock.pool, nullptr);
    clock = {};
}

void recordClockStart(VkCommandBuffer commands, const DeviceClock& clock) {
    if (!clock.pool) return;
    vkCmdResetQueryPool(commands, clock.pool, 0, kMoments);
    vkCmdWriteTimestamp(commands, VK_PIPELINE_STAGE_TOP_OF_PIPE_BIT, clock.pool, kStart);
}

void recordClockEnd(VkCommandBuffer commands, const DeviceClock& clock) {
    if (clock.pool) vkCmdWriteTimestamp(commands, VK_PIPELINE_STAGE_BOTTOM_OF_PIPE_BIT, clock.pool, kEnd);
}

std::optional<double> clockedMilliseconds(Device& device, const DeviceClock& clock) {
    if (!clock.pool) return {};
    std::array<std::uint64_t, kMoments> ticks{};
    check(vkGetQueryPoolResults(device.handle, clock.pool, 0, kMoments, sizeof ticks, ticks.data(), sizeof ticks[0],
                                VK_QUERY_RESULT_64_BIT | VK_QUERY_RESULT_WAIT_BIT),
          "read the device's clock");
    return static_cast<double>((ticks[kEnd] - ticks[kStart]) & clock.mask) * clock.tick_ms;
}

} // namespace pointrt

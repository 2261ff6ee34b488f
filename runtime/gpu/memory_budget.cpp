// SPDX-License-Identifier: Apache-2.0
#include "runtime/gpu/memory_budget.h"

#include <algorithm>
#include <optional>

#include "runtime/gpu/device_choice.h"

namespace pointrt {
namespace {

std::optional<std::uint32_t> largestOwnHeap(const VkPhysicalDeviceMemoryProperties& memory) {
    std::optional<std::uint32_t> largest;
    for (std::uint32_t i = 0; i < memory.memoryHeapCount; ++i)
        if ((memory.memoryHeaps[i].flags & VK_MEMORY_HEAP_DEVICE_LOCAL_BIT) &&
            (!largest || memory.memoryHeaps[i].size > memory.memoryHeaps[*largest].size))
            largest = i;
    return largest;
}

} // namespace

std::uint64_t availableDeviceMemory(const Device& device) {
    const auto heap = largestOwnHeap(device.memory);
    if (!heap) return 0;
    if (!hasExtension(device.physical, VK_EXT_MEMORY_BUDGET_EXTENSION_NAME))
        return device.memory.memoryHeaps[*heap].size;
    VkPhysicalDeviceMemoryBudgetPropertiesEXT budget{VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_MEMORY_BUDGET_PROPERTIES_EXT};
    VkPhysicalDeviceMemoryProperties2 properties{VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_MEMORY_PROPERTIES_2, &budget, {}};
    vkGetPhysicalDeviceMemoryProperties2(device.physical, &properties);
    return budget.heapBudget[*heap] - std::min(budget.heapUsage[*heap], budget.heapBudget[*heap]);
}

} // namespace pointrt

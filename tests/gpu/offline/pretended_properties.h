// SPDX-License-Identifier: Apache-2.0
// The layer's settings, and the types, limits and memory of the devices that it simulates.
#pragma once

#include <vulkan/vulkan.h>

#include <algorithm>
#include <chrono>
#include <cstdint>
#include <cstdlib>
#include <string>
#include <string_view>
#include <thread>
#include <vector>

namespace pretended {

inline std::string_view setting(const char* name) {
    const char* value = std::getenv(name);
    return value ? value : "";
}
inline std::uint64_t number(const char* name) { return std::strtoull(std::string(setting(name)).c_str(), nullptr, 10); }
inline void delay(const char* name) {
    if (const std::uint64_t us = number(name)) std::this_thread::sleep_for(std::chrono::microseconds(us));
}

inline constexpr VkMemoryPropertyFlags kLocal = VK_MEMORY_PROPERTY_DEVICE_LOCAL_BIT,
                                       kVisible = VK_MEMORY_PROPERTY_HOST_VISIBLE_BIT,
                                       kCoherent = VK_MEMORY_PROPERTY_HOST_COHERENT_BIT,
                                       kCached = VK_MEMORY_PROPERTY_HOST_CACHED_BIT;

struct MemoryTable {
    std::string_view name;
    std::vector<VkMemoryPropertyFlags> types;
};
inline const MemoryTable kTables[] = {
    {"discrete", {kLocal, kVisible | kCoherent, kVisible | kCoherent | kCached}},
    // an APU of AMD: its own memory is write-combined
    {"write_combined", {kLocal, kLocal | kVisible | kCoherent, kVisible | kCoherent | kCached}},
    // Intel since Meteor Lake: cached memory is not coherent
    {"incoherent", {kLocal | kVisible | kCoherent, kLocal | kVisible | kCached}},
};

inline const MemoryTable* memoryTable() {
    const std::string_view wanted = setting("POINTRT_LAYER_MEMORY");
    for (const MemoryTable& each : kTables)
        if (each.name == wanted) return &each;
    return nullptr;
}

/// Both heaps are those of the driver, which has one.
inline void pretendMemory(VkPhysicalDeviceMemoryProperties& memory) {
    const MemoryTable* table = memoryTable();
    if (!table) return;
    memory.memoryTypeCount = static_cast<std::uint32_t>(table->types.size());
    memory.memoryHeapCount = 2;
    memory.memoryHeaps[1] = {memory.memoryHeaps[0].size, 0};
    for (std::uint32_t i = 0; i < memory.memoryTypeCount; ++i)
        memory.memoryTypes[i] = {table->types[i], table->types[i] & kLocal ? 0u : 1u};
}

/// Takes VK_EXT_memory_budget's structure out of the chain, which the driver may not know.
inline VkPhysicalDeviceMemoryBudgetPropertiesEXT* takeBudget(VkPhysicalDeviceMemoryProperties2& properties) {
    auto* before = reinterpret_cast<VkBaseOutStructure*>(&properties);
    for (; before->pNext; before = before->pNext) {
        if (before->pNext->sType != VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_MEMORY_BUDGET_PROPERTIES_EXT) continue;
        auto* budget = reinterpret_cast<VkPhysicalDeviceMemoryBudgetPropertiesEXT*>(before->pNext);
        before->pNext = before->pNext->pNext;
        return budget;
    }
    return nullptr;
}

inline std::uint32_t allTypes() { return (1u << memoryTable()->types.size()) - 1; }

inline void setLimit(VkPhysicalDeviceLimits& limits, std::string_view name, std::uint32_t value) {
#define LAYER_LIMIT(member)                                                                                            \
    if (name == #member) limits.member = std::min(limits.member, value);
    LAYER_LIMIT(maxStorageBufferRange)
    LAYER_LIMIT(maxTexelBufferElements)
    LAYER_LIMIT(maxPerStageDescriptorStorageBuffers)
    LAYER_LIMIT(maxPerStageDescriptorStorageImages)
    LAYER_LIMIT(maxPerStageDescriptorSampledImages)
    LAYER_LIMIT(maxMemoryAllocationCount)
#undef LAYER_LIMIT
}

inline void pretendLimits(VkPhysicalDeviceLimits& limits) {
    std::string_view rest = setting("POINTRT_LAYER_LIMITS");
    while (!rest.empty()) {
        const std::string_view entry = rest.substr(0, rest.find(','));
        rest.remove_prefix(std::min(rest.size(), entry.size() + 1));
        const std::size_t equals = entry.find('=');
        if (equals == std::string_view::npos) continue;
        const std::string value(entry.substr(equals + 1));
        setLimit(limits, entry.substr(0, equals), static_cast<std::uint32_t>(std::strtoul(value.c_str(), nullptr, 10)));
    }
}

inline void pretend(VkPhysicalDeviceProperties& properties) {
    const std::string_view type = setting("POINTRT_LAYER_TYPE");
    if (type == "discrete") properties.deviceType = VK_PHYSICAL_DEVICE_TYPE_DISCRETE_GPU;
    if (type == "integrated") properties.deviceType = VK_PHYSICAL_DEVICE_TYPE_INTEGRATED_GPU;
    pretendLimits(properties.limits);
    if (const std::uint64_t times = number("POINTRT_LAYER_FASTER"))
        properties.limits.timestampPeriod /= static_cast<float>(times);
}

} // namespace pretended

// SPDX-License-Identifier: Apache-2.0
// A Vulkan layer for tests: counts calls (of waits, those that block), and makes the driver below look like another
// device. Environment variables: POINTRT_LAYER_TYPE=discrete|integrated     the device's type
// POINTRT_LAYER_MEMORY=discrete|write_combined|incoherent   its memory types (kTables)
// POINTRT_LAYER_LIMITS=NAME=N,...            smaller limits: members of VkPhysicalDeviceLimits (setLimit)
// POINTRT_LAYER_SUBGROUPS=N                  subgroups of N lanes, and of 32 to N for programs that request them
// POINTRT_LAYER_SUBMIT_US=N, POINTRT_LAYER_ALLOCATE_US=N    latency added to each submission and allocation
// POINTRT_LAYER_FASTER=N                     by its own clock the device takes an N-th of the time
// POINTRT_LAYER_LOST_AT=N                    the N-th submission to a device and all after it lose the device
// POINTRT_LAYER_LOST_DEVICES=N               only the first N devices of the process are lost
// POINTRT_LAYER_BUDGET=N                     bytes of the heap that VK_EXT_memory_budget allows; half are in use
// POINTRT_LAYER_PIPELINES=1                  pipeline caches keep something: a word for each pipeline built with them
// POINTRT_LAYER_COUNTS=FILE                  the counts as JSON, written as the instance is destroyed
// pointrtLayerCount gives a process the counts while it runs. One instance and one device at a time.
//
// The driver below must have one memory type that can do everything, as lavapipe has. Memory that the pretended device
// does not keep coherent, or that is slow to read, is mapped as a copy: what the host neither flushes nor invalidates
// is stale, and what it reads from write-combined memory is only what it wrote.
#include <vulkan/vk_layer.h>
#include <vulkan/vulkan.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <map>
#include <memory>
#include <mutex>
#include <string_view>
#include <vector>

#include "tests/gpu/offline/pretended_properties.h"

namespace {

using namespace pretended;

// --- Counts ---

#define LAYER_COUNTS(X)                                                                                                \
    X(submits)                                                                                                         \
    X(waits)                                                                                                           \
    X(allocations)                                                                                                     \
    X(maps)                                                                                                            \
    X(buffers)                                                                                                         \
    X(dispatches)                                                                                                      \
    X(barriers)                                                                                                        \
    X(copies)                                                                                                          \
    X(pipelines)                                                                                                       \
    X(pipelines_of_32)                                                                                                 \
    X(kept_pipelines)                                                                                                  \
    X(labels)                                                                                                          \
    X(ended_labels)
#define LAYER_ENUMERATE(name) name,
enum class Count { LAYER_COUNTS(LAYER_ENUMERATE) kEnd };
#define LAYER_NAME(name) #name,
constexpr const char* kCountNames[] = {LAYER_COUNTS(LAYER_NAME)};
std::array<std::atomic<std::uint64_t>, static_cast<std::size_t>(Count::kEnd)> counts{};

void count(Count what) { ++counts[static_cast<std::size_t>(what)]; }

void writeCounts() {
    const char* path = std::getenv("POINTRT_LAYER_COUNTS");
    std::FILE* file = path ? std::fopen(path, "w") : nullptr;
    if (!file) return;
    for (std::size_t i = 0; i < counts.size(); ++i)
        std::fprintf(file, "%s\"%s\": %llu", i == 0 ? "{" : ", ", kCountNames[i],
                     static_cast<unsigned long long>(counts[i].load()));
    std::fprintf(file, "}\n");
    std::fclose(file);
}

// --- The driver's functions ---

PFN_vkGetInstanceProcAddr instance_proc = nullptr;
PFN_vkGetDeviceProcAddr device_proc = nullptr;
VkInstance the_instance = VK_NULL_HANDLE;

/// Functions of the instance that the layer calls. They are loaded when the instance is created: later, the loader
/// would return those of the topmost layer, which may be this one.
#define LAYER_INSTANCE_FUNCTIONS(X)                                                                                    \
    X(vkDestroyInstance)                                                                                               \
    X(vkEnumerateDeviceExtensionProperties)                                                                            \
    X(vkGetPhysicalDeviceProperties)                                                                                   \
    X(vkGetPhysicalDeviceProperties2)                                                                                  \
    X(vkGetPhysicalDeviceMemoryProperties)                                                                             \
    X(vkGetPhysicalDeviceMemoryProperties2)

/// Functions of the device that the layer calls.
#define LAYER_DEVICE_FUNCTIONS(X)                                                                                      \
    X(vkAllocateMemory)                                                                                                \
    X(vkFreeMemory)                                                                                                    \
    X(vkMapMemory)                                                                                                     \
    X(vkUnmapMemory)                                                                                                   \
    X(vkFlushMappedMemoryRanges)                                                                                       \
    X(vkInvalidateMappedMemoryRanges)                                                                                  \
    X(vkGetBufferMemoryRequirements)                                                                                   \
    X(vkGetImageMemoryRequirements)                                                                                    \
    X(vkGetMemoryHostPointerPropertiesEXT)                                                                             \
    X(vkQueueSubmit)                                                                                                   \
    X(vkWaitForFences)                                                                                                 \
    X(vkWaitSemaphores)                                                                                                \
    X(vkCreateBuffer)                                                                                                  \
    X(vkCreateComputePipelines)                                                                                        \
    X(vkCreatePipelineCache)                                                                                           \
    X(vkGetPipelineCacheData)                                                                                          \
    X(vkCmdBeginDebugUtilsLabelEXT)                                                                                    \
    X(vkCmdEndDebugUtilsLabelEXT)                                                                                      \
    X(vkCmdDispatch)                                                                                                   \
    X(vkCmdDispatchIndirect)                                                                                           \
    X(vkCmdPipelineBarrier)                                                                                            \
    X(vkCmdCopyBuffer)                                                                                                 \
    X(vkCmdUpdateBuffer)
#define LAYER_MEMBER(name) PFN_##name name = nullptr;
struct Driver {
    LAYER_INSTANCE_FUNCTIONS(LAYER_MEMBER)
    LAYER_DEVICE_FUNCTIONS(LAYER_MEMBER)
} driver;

// --- Memory ---

/// Memory of a pretended type: what is mapped is a copy unless the type is coherent and cached.
struct Pretended {
    VkMemoryPropertyFlags flags = 0;
    std::uint64_t bytes = 0;
    void* real = nullptr;
    std::vector<std::byte> copy; ///< empty: not mapped, or mapped as it is
};
std::mutex memory_mutex;
std::map<VkDeviceMemory, Pretended> memories;

bool isCopied(VkMemoryPropertyFlags flags) { return (flags & (kCoherent | kCached)) != (kCoherent | kCached); }

VKAPI_ATTR VkResult VKAPI_CALL AllocateMemory(VkDevice device, const VkMemoryAllocateInfo* info,
                                              const VkAllocationCallbacks* callbacks, VkDeviceMemory* memory) {
    count(Count::allocations);
    delay("POINTRT_LAYER_ALLOCATE_US");
    const MemoryTable* table = memoryTable();
    VkMemoryAllocateInfo real = *info;
    if (table) real.memoryTypeIndex = 0;
    const VkResult result = driver.vkAllocateMemory(device, &real, callbacks, memory);
    if (result != VK_SUCCESS || !table) return result;
    const std::lock_guard lock(memory_mutex);
    memories[*memory] = {table->types.at(info->memoryTypeIndex), info->allocationSize, nullptr, {}};
    return result;
}

VKAPI_ATTR void VKAPI_CALL FreeMemory(VkDevice device, VkDeviceMemory memory, const VkAllocationCallbacks* callbacks) {
    {
        const std::lock_guard lock(memory_mutex);
        memories.erase(memory);
    }
    driver.vkFreeMemory(device, memory, callbacks);
}

VKAPI_ATTR VkResult VKAPI_CALL MapMemory(VkDevice device, VkDeviceMemory memory, VkDeviceSize offset,
                                         VkDeviceSize bytes, VkMemoryMapFlags flags, void** data) {
    count(Count::maps);
    const std::lock_guard lock(memory_mutex);
    const auto found = memories.find(memory);
    if (found == memories.end()) return driver.vkMapMemory(device, memory, offset, bytes, flags, data);
    Pretended& pretended = found->second;
    if (!(pretended.flags & kVisible)) return VK_ERROR_MEMORY_MAP_FAILED;
    const VkResult result = driver.vkMapMemory(device, memory, 0, VK_WHOLE_SIZE, flags, &pretended.real);
    if (result != VK_SUCCESS) return result;
    auto* mapped = static_cast<std::byte*>(pretended.real);
    if (isCopied(pretended.flags)) {
        pretended.copy.assign(mapped, mapped + pretended.bytes);
        mapped = pretended.copy.data();
    }
    *data = mapped + offset;
    return VK_SUCCESS;
}

VKAPI_ATTR void VKAPI_CALL UnmapMemory(VkDevice device, VkDeviceMemory memory) {
    const std::lock_guard lock(memory_mutex);
    if (const auto found = memories.find(memory); found != memories.end()) found->second.copy.clear();
    driver.vkUnmapMemory(device, memory);
}

enum class Direction { kFlush, kInvalidate };

VkResult copyRanges(std::uint32_t range_count, const VkMappedMemoryRange* ranges, Direction direction) {
    const std::lock_guard lock(memory_mutex);
    for (std::uint32_t i = 0; i < range_count; ++i) {
        const auto found = memories.find(ranges[i].memory);
        if (found == memories.end() || found->second.copy.empty()) continue;
        Pretended& memory = found->second;
        const std::uint64_t offset = ranges[i].offset, bytes = std::min(ranges[i].size, memory.bytes - offset);
        std::byte* const real = static_cast<std::byte*>(memory.real) + offset;
        std::byte* const copy = memory.copy.data() + offset;
        std::memcpy(direction == Direction::kFlush ? real : copy, direction == Direction::kFlush ? copy : real, bytes);
    }
    return VK_SUCCESS;
}

VKAPI_ATTR VkResult VKAPI_CALL FlushMappedMemoryRanges(VkDevice, std::uint32_t n, const VkMappedMemoryRange* ranges) {
    return copyRanges(n, ranges, Direction::kFlush);
}
VKAPI_ATTR VkResult VKAPI_CALL InvalidateMappedMemoryRanges(VkDevice, std::uint32_t n,
                                                            const VkMappedMemoryRange* ranges) {
    return copyRanges(n, ranges, Direction::kInvalidate);
}

/// Data that the host has written to coherent memory becomes visible with a submission.
void flushCoherent() {
    const std::lock_guard lock(memory_mutex);
    for (auto& [handle, memory] : memories)
        if ((memory.flags & kCoherent) && !memory.copy.empty())
            std::memcpy(memory.real, memory.copy.data(), memory.copy.size());
}

VKAPI_ATTR void VKAPI_CALL GetBufferMemoryRequirements(VkDevice device, VkBuffer buffer,
                                                       VkMemoryRequirements* requirements) {
    driver.vkGetBufferMemoryRequirements(device, buffer, requirements);
    if (memoryTable()) requirements->memoryTypeBits = allTypes();
}
VKAPI_ATTR void VKAPI_CALL GetImageMemoryRequirements(VkDevice device, VkImage image,
                                                      VkMemoryRequirements* requirements) {
    driver.vkGetImageMemoryRequirements(device, image, requirements);
    if (memoryTable()) requirements->memoryTypeBits = allTypes();
}
VKAPI_ATTR VkResult VKAPI_CALL GetMemoryHostPointerPropertiesEXT(VkDevice device,
                                                                 VkExternalMemoryHandleTypeFlagBits type,
                                                                 const void* data,
                                                                 VkMemoryHostPointerPropertiesEXT* properties) {
    const VkResult result = driver.vkGetMemoryHostPointerPropertiesEXT(device, type, data, properties);
    if (memoryTable()) properties->memoryTypeBits = allTypes();
    return result;
}

// --- Work ---

std::atomic<std::uint64_t> submits_to_device = 0, devices = 0;

/// Whether a device is lost after this many submissions.
bool isLost(std::uint64_t submits) {
    const std::uint64_t lost_at = number("POINTRT_LAYER_LOST_AT"), most = number("POINTRT_LAYER_LOST_DEVICES");
    return lost_at > 0 && submits >= lost_at && (most == 0 || devices <= most);
}

VKAPI_ATTR VkResult VKAPI_CALL QueueSubmit(VkQueue queue, std::uint32_t n, const VkSubmitInfo* submits, VkFence fence) {
    count(Count::submits);
    if (isLost(++submits_to_device)) return VK_ERROR_DEVICE_LOST;
    delay("POINTRT_LAYER_SUBMIT_US");
    flushCoherent();
    return driver.vkQueueSubmit(queue, n, submits, fence);
}
VKAPI_ATTR VkResult VKAPI_CALL WaitForFences(VkDevice device, std::uint32_t n, const VkFence* fences, VkBool32 all,
                                             std::uint64_t timeout) {
    const VkResult now = driver.vkWaitForFences(device, n, fences, all, 0);
    if (now != VK_TIMEOUT || timeout == 0) return now;
    count(Count::waits);
    return driver.vkWaitForFences(device, n, fences, all, timeout);
}
VKAPI_ATTR VkResult VKAPI_CALL WaitSemaphores(VkDevice device, const VkSemaphoreWaitInfo* info, std::uint64_t timeout) {
    const VkResult now = driver.vkWaitSemaphores(device, info, 0);
    if (now != VK_TIMEOUT || timeout == 0) return now;
    count(Count::waits);
    return driver.vkWaitSemaphores(device, info, timeout);
}
VKAPI_ATTR VkResult VKAPI_CALL CreateBuffer(VkDevice device, const VkBufferCreateInfo* info,
                                            const VkAllocationCallbacks* callbacks, VkBuffer* buffer) {
    count(Count::buffers);
    return driver.vkCreateBuffer(device, info, callbacks, buffer);
}
VKAPI_ATTR void VKAPI_CALL CmdBeginDebugUtilsLabelEXT(VkCommandBuffer commands, const VkDebugUtilsLabelEXT* label) {
    count(Count::labels);
    if (driver.vkCmdBeginDebugUtilsLabelEXT) driver.vkCmdBeginDebugUtilsLabelEXT(commands, label);
}
VKAPI_ATTR void VKAPI_CALL CmdEndDebugUtilsLabelEXT(VkCommandBuffer commands) {
    count(Count::ended_labels);
    if (driver.vkCmdEndDebugUtilsLabelEXT) driver.vkCmdEndDebugUtilsLabelEXT(commands);
}

/// Takes away a pretended size of subgroups, which is the only structure in the chain.
void takeSubgroupSize(VkPipelineShaderStageCreateInfo& stage) {
    const auto* size = static_cast<const VkPipelineShaderStageRequiredSubgroupSizeCreateInfo*>(stage.pNext);
    if (!size || size->sType != VK_STRUCTURE_TYPE_PIPELINE_SHADER_STAGE_REQUIRED_SUBGROUP_SIZE_CREATE_INFO) return;
    if (size->requiredSubgroupSize == 32) count(Count::pipelines_of_32);
    stage.pNext = nullptr;
}

// --- Pipeline caches: lavapipe's never contain anything ---

/// Pipelines in the cache of the process.
std::atomic<std::uint64_t> cached_pipelines = 0;

VKAPI_ATTR VkResult VKAPI_CALL CreatePipelineCache(VkDevice device, const VkPipelineCacheCreateInfo* info,
                                                   const VkAllocationCallbacks* callbacks, VkPipelineCache* cache) {
    constexpr std::size_t kHeader = sizeof(VkPipelineCacheHeaderVersionOne);
    cached_pipelines = info->initialDataSize > kHeader ? (info->initialDataSize - kHeader) / sizeof(std::uint64_t) : 0;
    counts[static_cast<std::size_t>(Count::kept_pipelines)] += cached_pipelines;
    VkPipelineCacheCreateInfo header = *info;
    header.initialDataSize = std::min(info->initialDataSize, kHeader);
    return driver.vkCreatePipelineCache(device, &header, callbacks, cache);
}
VKAPI_ATTR VkResult VKAPI_CALL GetPipelineCacheData(VkDevice device, VkPipelineCache cache, std::size_t* bytes,
                                                    void* data) {
    std::size_t header = sizeof(VkPipelineCacheHeaderVersionOne);
    const std::size_t more = number("POINTRT_LAYER_PIPELINES") ? cached_pipelines * sizeof(std::uint64_t) : 0;
    if (data && *bytes < header + more) return VK_INCOMPLETE;
    *bytes = header + more;
    if (data) std::memset(data, 0, *bytes);
    return data ? driver.vkGetPipelineCacheData(device, cache, &header, data) : VK_SUCCESS;
}
VKAPI_ATTR VkResult VKAPI_CALL CreateComputePipelines(VkDevice device, VkPipelineCache cache, std::uint32_t n,
                                                      const VkComputePipelineCreateInfo* infos,
                                                      const VkAllocationCallbacks* callbacks, VkPipeline* pipelines) {
    count(Count::pipelines);
    if (cache) ++cached_pipelines;
    std::vector<VkComputePipelineCreateInfo> real(infos, infos + n);
    for (VkComputePipelineCreateInfo& info : real) takeSubgroupSize(info.stage);
    return driver.vkCreateComputePipelines(device, cache, n, real.data(), callbacks, pipelines);
}
VKAPI_ATTR void VKAPI_CALL CmdDispatch(VkCommandBuffer commands, std::uint32_t x, std::uint32_t y, std::uint32_t z) {
    count(Count::dispatches);
    driver.vkCmdDispatch(commands, x, y, z);
}
VKAPI_ATTR void VKAPI_CALL CmdDispatchIndirect(VkCommandBuffer commands, VkBuffer buffer, VkDeviceSize offset) {
    count(Count::dispatches);
    driver.vkCmdDispatchIndirect(commands, buffer, offset);
}
VKAPI_ATTR void VKAPI_CALL CmdPipelineBarrier(VkCommandBuffer commands, VkPipelineStageFlags from,
                                              VkPipelineStageFlags to, VkDependencyFlags flags, std::uint32_t n,
                                              const VkMemoryBarrier* memory, std::uint32_t buffer_count,
                                              const VkBufferMemoryBarrier* buffers, std::uint32_t image_count,
                                              const VkImageMemoryBarrier* images) {
    count(Count::barriers);
    driver.vkCmdPipelineBarrier(commands, from, to, flags, n, memory, buffer_count, buffers, image_count, images);
}
VKAPI_ATTR void VKAPI_CALL CmdCopyBuffer(VkCommandBuffer commands, VkBuffer from, VkBuffer to, std::uint32_t n,
                                         const VkBufferCopy* regions) {
    count(Count::copies);
    driver.vkCmdCopyBuffer(commands, from, to, n, regions);
}
VKAPI_ATTR void VKAPI_CALL CmdUpdateBuffer(VkCommandBuffer commands, VkBuffer buffer, VkDeviceSize offset,
                                           VkDeviceSize bytes, const void* data) {
    count(Count::copies);
    driver.vkCmdUpdateBuffer(commands, buffer, offset, bytes, data);
}

// --- The device ---

VKAPI_ATTR void VKAPI_CALL GetPhysicalDeviceProperties(VkPhysicalDevice device, VkPhysicalDeviceProperties* out) {
    driver.vkGetPhysicalDeviceProperties(device, out);
    pretend(*out);
}
/// The structure of that type in a chain that starts at it; null if there is none.
template <typename Structure>
Structure* findIn(void* chain, VkStructureType type) {
    auto* at = static_cast<VkBaseOutStructure*>(chain);
    while (at && at->sType != type) at = at->pNext;
    return reinterpret_cast<Structure*>(at);
}

VKAPI_ATTR void VKAPI_CALL GetPhysicalDeviceProperties2(VkPhysicalDevice device, VkPhysicalDeviceProperties2* out) {
    driver.vkGetPhysicalDeviceProperties2(device, out);
    pretend(out->properties);
    const auto lanes = static_cast<std::uint32_t>(number("POINTRT_LAYER_SUBGROUPS"));
    if (lanes == 0) return;
    if (auto* usual =
            findIn<VkPhysicalDeviceSubgroupProperties>(out, VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_SUBGROUP_PROPERTIES))
        usual->subgroupSize = lanes;
    if (auto* sizes = findIn<VkPhysicalDeviceSubgroupSizeControlProperties>(
            out, VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_SUBGROUP_SIZE_CONTROL_PROPERTIES)) {
        sizes->minSubgroupSize = std::min(lanes, 32u);
        sizes->maxSubgroupSize = lanes;
    }
}
VKAPI_ATTR void VKAPI_CALL GetPhysicalDeviceMemoryProperties(VkPhysicalDevice device,
                                                             VkPhysicalDeviceMemoryProperties* out) {
    driver.vkGetPhysicalDeviceMemoryProperties(device, out);
    pretendMemory(*out);
}
VKAPI_ATTR void VKAPI_CALL GetPhysicalDeviceMemoryProperties2(VkPhysicalDevice device,
                                                              VkPhysicalDeviceMemoryProperties2* out) {
    VkPhysicalDeviceMemoryBudgetPropertiesEXT* const budget =
        number("POINTRT_LAYER_BUDGET") ? takeBudget(*out) : nullptr;
    driver.vkGetPhysicalDeviceMemoryProperties2(device, out);
    pretendMemory(out->memoryProperties);
    if (!budget) return;
    budget->heapBudget[0] = number("POINTRT_LAYER_BUDGET");
    budget->heapUsage[0] = budget->heapBudget[0] / 2;
}

VKAPI_ATTR VkResult VKAPI_CALL EnumerateDeviceExtensionProperties(VkPhysicalDevice device, const char* layer,
                                                                  std::uint32_t* n, VkExtensionProperties* out) {
    const std::uint32_t room = *n;
    const VkResult result = driver.vkEnumerateDeviceExtensionProperties(device, layer, n, out);
    if (layer || !number("POINTRT_LAYER_BUDGET") || result != VK_SUCCESS) return result;
    if (out && *n >= room) return VK_INCOMPLETE;
    if (out) out[*n] = {VK_EXT_MEMORY_BUDGET_EXTENSION_NAME, 1};
    ++*n;
    return VK_SUCCESS;
}

/// The link to the next layer in a chain of create infos; advances it.
template <typename Link>
Link* takeLink(const void* chain, VkStructureType type) {
    auto* link = static_cast<Link*>(const_cast<void*>(chain));
    while (link && !(link->sType == type && link->function == VK_LAYER_LINK_INFO))
        link = static_cast<Link*>(const_cast<void*>(link->pNext));
    return link;
}

VKAPI_ATTR VkResult VKAPI_CALL CreateInstance(const VkInstanceCreateInfo* info, const VkAllocationCallbacks* callbacks,
                                              VkInstance* instance) {
    auto* link = takeLink<VkLayerInstanceCreateInfo>(info->pNext, VK_STRUCTURE_TYPE_LOADER_INSTANCE_CREATE_INFO);
    instance_proc = link->u.pLayerInfo->pfnNextGetInstanceProcAddr;
    link->u.pLayerInfo = link->u.pLayerInfo->pNext;
    const VkResult result =
        reinterpret_cast<PFN_vkCreateInstance>(instance_proc(nullptr, "vkCreateInstance"))(info, callbacks, instance);
    if (result != VK_SUCCESS) return result;
    the_instance = *instance;
#define LAYER_LOAD_INSTANCE(name) driver.name = reinterpret_cast<PFN_##name>(instance_proc(the_instance, #name));
    LAYER_INSTANCE_FUNCTIONS(LAYER_LOAD_INSTANCE)
    return VK_SUCCESS;
}

VKAPI_ATTR void VKAPI_CALL DestroyInstance(VkInstance instance, const VkAllocationCallbacks* callbacks) {
    writeCounts();
    driver.vkDestroyInstance(instance, callbacks);
}

VKAPI_ATTR VkResult VKAPI_CALL CreateDevice(VkPhysicalDevice physical, const VkDeviceCreateInfo* info,
                                            const VkAllocationCallbacks* callbacks, VkDevice* device) {
    auto* link = takeLink<VkLayerDeviceCreateInfo>(info->pNext, VK_STRUCTURE_TYPE_LOADER_DEVICE_CREATE_INFO);
    const auto next_instance_proc = link->u.pLayerInfo->pfnNextGetInstanceProcAddr;
    device_proc = link->u.pLayerInfo->pfnNextGetDeviceProcAddr;
    link->u.pLayerInfo = link->u.pLayerInfo->pNext;
    const auto create = reinterpret_cast<PFN_vkCreateDevice>(next_instance_proc(the_instance, "vkCreateDevice"));
    const VkResult result = create(physical, info, callbacks, device);
    if (result != VK_SUCCESS) return result;
    ++devices;
    submits_to_device = 0;
#define LAYER_LOAD(name) driver.name = reinterpret_cast<PFN_##name>(device_proc(*device, #name));
    LAYER_DEVICE_FUNCTIONS(LAYER_LOAD)
    return VK_SUCCESS;
}

struct Hook {
    std::string_view name;
    PFN_vkVoidFunction function;
};
#define LAYER_HOOK(name)                                                                                               \
    { "vk" #name, reinterpret_cast<PFN_vkVoidFunction>(name) }

PFN_vkVoidFunction hookOf(std::string_view name);
VKAPI_ATTR PFN_vkVoidFunction VKAPI_CALL GetDeviceProcAddr(VkDevice device, const char* name) {
    const PFN_vkVoidFunction real = device_proc(device, name), hook = hookOf(name);
    return real && hook ? hook : real;
}
VKAPI_ATTR PFN_vkVoidFunction VKAPI_CALL GetInstanceProcAddr(VkInstance instance, const char* name) {
    if (const PFN_vkVoidFunction hook = hookOf(name)) return hook;
    return instance_proc ? instance_proc(instance, name) : nullptr;
}

PFN_vkVoidFunction hookOf(std::string_view name) {
    static const Hook kHooks[] = {LAYER_HOOK(CreateInstance),
                                  LAYER_HOOK(DestroyInstance),
                                  LAYER_HOOK(CreateDevice),
                                  LAYER_HOOK(GetInstanceProcAddr),
                                  LAYER_HOOK(GetDeviceProcAddr),
                                  LAYER_HOOK(EnumerateDeviceExtensionProperties),
                                  LAYER_HOOK(GetPhysicalDeviceProperties),
                                  LAYER_HOOK(GetPhysicalDeviceProperties2),
                                  LAYER_HOOK(GetPhysicalDeviceMemoryProperties),
                                  LAYER_HOOK(GetPhysicalDeviceMemoryProperties2),
                                  LAYER_HOOK(AllocateMemory),
                                  LAYER_HOOK(FreeMemory),
                                  LAYER_HOOK(MapMemory),
                                  LAYER_HOOK(UnmapMemory),
                                  LAYER_HOOK(FlushMappedMemoryRanges),
                                  LAYER_HOOK(InvalidateMappedMemoryRanges),
                                  LAYER_HOOK(GetBufferMemoryRequirements),
                                  LAYER_HOOK(GetImageMemoryRequirements),
                                  LAYER_HOOK(GetMemoryHostPointerPropertiesEXT),
                                  LAYER_HOOK(QueueSubmit),
                                  LAYER_HOOK(WaitForFences),
                                  LAYER_HOOK(WaitSemaphores),
                                  LAYER_HOOK(CreateBuffer),
                                  LAYER_HOOK(CreateComputePipelines),
                                  LAYER_HOOK(CreatePipelineCache),
                                  LAYER_HOOK(GetPipelineCacheData),
                                  LAYER_HOOK(CmdBeginDebugUtilsLabelEXT),
                                  LAYER_HOOK(CmdEndDebugUtilsLabelEXT),
                                  LAYER_HOOK(CmdDispatch),
                                  LAYER_HOOK(CmdDispatchIndirect),
                                  LAYER_HOOK(CmdPipelineBarrier),
                                  LAYER_HOOK(CmdCopyBuffer),
                                  LAYER_HOOK(CmdUpdateBuffer)};
    const auto found =
        std::find_if(std::begin(kHooks), std::end(kHooks), [&](const Hook& hook) { return hook.name == name; });
    return found == std::end(kHooks) ? nullptr : found->function;
}

} // namespace

extern "C" {

/// A count by its name, since the process started; 0 if there is no such count.
__attribute__((visibility("default"))) std::uint64_t pointrtLayerCount(const char* name) {
    for (std::size_t i = 0; i < counts.size(); ++i)
        if (std::strcmp(name, kCountNames[i]) == 0) return counts[i];
    return 0;
}

__attribute__((visibility("default"))) VKAPI_ATTR VkResult VKAPI_CALL
vkNegotiateLoaderLayerInterfaceVersion(VkNegotiateLayerInterface* interface) {
    interface->loaderLayerInterfaceVersion = 2;
    interface->pfnGetInstanceProcAddr = GetInstanceProcAddr;
    interface->pfnGetDeviceProcAddr = GetDeviceProcAddr;
    interface->pfnGetPhysicalDeviceProcAddr = nullptr;
    return VK_SUCCESS;
}
}

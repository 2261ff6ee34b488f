// SPDX-License-Identifier: Apache-2.0
#include "runtime/gpu/device_choice.h"

#include <algorithm>
#include <charconv>
#include <cstdio>
#include <cstring>

#include "format/base/error.h"
#include "runtime/util/words.h"

namespace pointrt {
namespace {

// A scene of a million splats has some three million texels of near splats; entry grids have up to 2^24 words.
constexpr std::uint32_t kMinTexels = 1u << 24;
constexpr VkSubgroupFeatureFlags kSubgroupOperations = VK_SUBGROUP_FEATURE_BASIC_BIT | VK_SUBGROUP_FEATURE_VOTE_BIT |
                                                       VK_SUBGROUP_FEATURE_ARITHMETIC_BIT |
                                                       VK_SUBGROUP_FEATURE_BALLOT_BIT;

std::optional<std::uint32_t> queueFamily(VkPhysicalDevice physical, const QueueNeeds& needs) {
    VkQueueFlags wanted = VK_QUEUE_COMPUTE_BIT;
    if (needs.graphics || needs.present) wanted |= VK_QUEUE_GRAPHICS_BIT;
    std::uint32_t count = 0;
    vkGetPhysicalDeviceQueueFamilyProperties(physical, &count, nullptr);
    std::vector<VkQueueFamilyProperties> families(count);
    vkGetPhysicalDeviceQueueFamilyProperties(physical, &count, families.data());
    for (std::uint32_t i = 0; i < count; ++i)
        if ((families[i].queueFlags & wanted) == wanted && (!needs.can_present || needs.can_present(physical, i)))
            return i;
    return {};
}

std::string versionText(std::uint32_t version) {
    return std::to_string(VK_API_VERSION_MAJOR(version)) + "." + std::to_string(VK_API_VERSION_MINOR(version)) + "." +
           std::to_string(VK_API_VERSION_PATCH(version));
}

bool readsTexels(VkPhysicalDevice physical) {
    for (VkFormat format : {VK_FORMAT_R32_UINT, VK_FORMAT_R32G32B32A32_UINT, VK_FORMAT_R32G32B32A32_SFLOAT}) {
        VkFormatProperties properties;
        vkGetPhysicalDeviceFormatProperties(physical, format, &properties);
        if (!(properties.bufferFeatures & VK_FORMAT_FEATURE_UNIFORM_TEXEL_BUFFER_BIT)) return false;
    }
    return true;
}

const char* typeName(VkPhysicalDeviceType type) {
    switch (type) {
    case VK_PHYSICAL_DEVICE_TYPE_DISCRETE_GPU:
        return "discrete";
    case VK_PHYSICAL_DEVICE_TYPE_INTEGRATED_GPU:
        return "integrated";
    case VK_PHYSICAL_DEVICE_TYPE_VIRTUAL_GPU:
        return "virtual";
    case VK_PHYSICAL_DEVICE_TYPE_CPU:
        return "CPU";
    default:
        return "other";
    }
}

/// Higher is better.
int typeRank(VkPhysicalDeviceType type) {
    switch (type) {
    case VK_PHYSICAL_DEVICE_TYPE_DISCRETE_GPU:
        return 4;
    case VK_PHYSICAL_DEVICE_TYPE_INTEGRATED_GPU:
        return 3;
    case VK_PHYSICAL_DEVICE_TYPE_VIRTUAL_GPU:
        return 2;
    case VK_PHYSICAL_DEVICE_TYPE_CPU:
        return 1;
    default:
        return 0;
    }
}

/// Whether the user's selector matches candidate number index.
bool matches(const std::string& selector, const Candidate& candidate, std::size_t index) {
    std::size_t number = 0;
    const char* end = selector.data() + selector.size();
    const auto [rest, error] = std::from_chars(selector.data(), end, number);
    if (error == std::errc() && rest == end) return number == index;
    return lowerCase(candidate.properties.deviceName).find(lowerCase(selector)) != std::string::npos;
}

std::string numberedName(const Candidate& candidate, std::size_t index) {
    return std::to_string(index) + " \"" + candidate.properties.deviceName + "\"";
}

/// Lists all candidates: '0 "NAME": reason; 1 "NAME": reason'.
std::string refusals(const std::vector<Candidate>& candidates, const std::string& selector) {
    std::string text;
    for (std::size_t i = 0; i < candidates.size(); ++i) {
        const Candidate& candidate = candidates[i];
        text += (i ? "; " : "") + numberedName(candidate, i) + ": ";
        text += matches(selector, candidate, i) ? candidate.refusal : "does not match \"" + selector + "\"";
    }
    return text;
}

std::uint64_t deviceLocalBytes(const VkPhysicalDeviceMemoryProperties& memory) {
    std::uint64_t bytes = 0;
    for (std::uint32_t i = 0; i < memory.memoryHeapCount; ++i)
        if (memory.memoryHeaps[i].flags & VK_MEMORY_HEAP_DEVICE_LOCAL_BIT) bytes += memory.memoryHeaps[i].size;
    return bytes;
}

const char* missingQueue(const QueueNeeds& needs) {
    if (needs.present) return "no queue for compute, graphics and presenting to this display";
    return needs.graphics ? "no queue for both compute and graphics" : "no compute queue";
}

void inspectSubgroupSizes(Candidate& candidate) {
    if (!hasExtension(candidate.physical, VK_EXT_SUBGROUP_SIZE_CONTROL_EXTENSION_NAME)) return;
    VkPhysicalDeviceSubgroupSizeControlFeaturesEXT control{
        VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_SUBGROUP_SIZE_CONTROL_FEATURES_EXT};
    VkPhysicalDeviceFeatures2 features{VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_FEATURES_2, &control};
    vkGetPhysicalDeviceFeatures2(candidate.physical, &features);
    VkPhysicalDeviceSubgroupSizeControlPropertiesEXT sizes{
        VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_SUBGROUP_SIZE_CONTROL_PROPERTIES_EXT};
    VkPhysicalDeviceProperties2 properties{VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_PROPERTIES_2, &sizes};
    vkGetPhysicalDeviceProperties2(candidate.physical, &properties);
    if (!control.subgroupSizeControl || !(sizes.requiredSubgroupSizeStages & VK_SHADER_STAGE_COMPUTE_BIT)) return;
    candidate.least_subgroup = sizes.minSubgroupSize;
    candidate.largest_subgroup = sizes.maxSubgroupSize;
}

bool hasRayQueries(VkPhysicalDevice physical) {
    if (!std::all_of(std::begin(kRayExtensions), std::end(kRayExtensions),
                     [&](const char* name) { return hasExtension(physical, name); }))
        return false;
    RayFeatures rays;
    VkPhysicalDeviceFeatures2 features{VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_FEATURES_2, rays.chainBefore(nullptr)};
    vkGetPhysicalDeviceFeatures2(physical, &features);
    return rays.all();
}

Candidate inspect(VkPhysicalDevice physical, const QueueNeeds& needs) {
    Candidate candidate;
    candidate.physical = physical;
    vkGetPhysicalDeviceProperties(physical, &candidate.properties);
    vkGetPhysicalDeviceMemoryProperties(physical, &candidate.memory);
    candidate.needs = needs;
    candidate.queue_family = queueFamily(physical, needs);
    candidate.swapchain = needs.present && hasExtension(physical, VK_KHR_SWAPCHAIN_EXTENSION_NAME);
    candidate.reads_texels = readsTexels(physical);
    VkPhysicalDeviceFeatures features;
    vkGetPhysicalDeviceFeatures(physical, &features);
    candidate.doubles = features.shaderFloat64;
    // vkGetPhysicalDeviceProperties2 and the structures chained to it are core since 1.1.
    if (candidate.properties.apiVersion >= VK_API_VERSION_1_1) {
        candidate.external_memory_host = hasExtension(physical, VK_EXT_EXTERNAL_MEMORY_HOST_EXTENSION_NAME);
        VkPhysicalDeviceExternalMemoryHostPropertiesEXT host{
            VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_EXTERNAL_MEMORY_HOST_PROPERTIES_EXT};
        candidate.subgroup = {VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_SUBGROUP_PROPERTIES};
        candidate.maintenance3 = {VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_MAINTENANCE_3_PROPERTIES};
        candidate.maintenance3.pNext = &candidate.subgroup;
        if (candidate.external_memory_host) candidate.subgroup.pNext = &host;
        VkPhysicalDeviceProperties2 properties{VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_PROPERTIES_2, &candidate.maintenance3};
        vkGetPhysicalDeviceProperties2(physical, &properties);
        candidate.host_import_alignment = host.minImportedHostPointerAlignment;
        candidate.maintenance3.pNext = candidate.subgroup.pNext = nullptr;
        inspectSubgroupSizes(candidate);
        candidate.ray_queries = hasRayQueries(physical);
    }
    candidate.refusal = refusalOf(candidate);
    return candidate;
}

/// The kind of descriptor that the device supports too few of, if any.
std::string missingDescriptors(const VkPhysicalDeviceLimits& limits) {
    const struct {
        const char* what;
        std::uint32_t limit, needed;
    } kinds[] = {
        {"storage texel buffers", limits.maxPerStageDescriptorStorageImages, kRenderDescriptors.storage_texel_buffers},
        {"uniform texel buffers", limits.maxPerStageDescriptorSampledImages, kRenderDescriptors.uniform_texel_buffers},
        {"storage buffers", limits.maxPerStageDescriptorStorageBuffers, kRenderDescriptors.storage_buffers},
        {"uniform buffers", limits.maxPerStageDescriptorUniformBuffers, kRenderDescriptors.uniform_buffers}};
    for (const auto& each : kinds)
        if (each.limit < each.needed)
            return "programs may bind " + std::to_string(each.limit) + " " + each.what + ", but " +
                   std::to_string(each.needed) + " are needed";
    return {};
}

} // namespace

bool hasExtension(VkPhysicalDevice physical, const char* name) {
    std::uint32_t count = 0;
    check(vkEnumerateDeviceExtensionProperties(physical, nullptr, &count, nullptr), "list device extensions");
    std::vector<VkExtensionProperties> extensions(count);
    check(vkEnumerateDeviceExtensionProperties(physical, nullptr, &count, extensions.data()), "list device extensions");
    return std::any_of(extensions.begin(), extensions.end(),
                       [&](const VkExtensionProperties& e) { return std::strcmp(e.extensionName, name) == 0; });
}

std::uint32_t subgroupSizeFor(const Candidate& candidate) {
    constexpr std::uint32_t kLanes = 32;
    const bool may_ask = candidate.least_subgroup <= kLanes && kLanes <= candidate.largest_subgroup;
    return may_ask && candidate.subgroup.subgroupSize > kLanes ? kLanes : 0;
}

bool queriesRays(const Candidate& candidate, Traversal traversal) {
    if (traversal == Traversal::kHardware && !candidate.ray_queries)
        throw Error{ExitCode::kCannotRun, "--rays hardware: " + std::string(candidate.properties.deviceName) +
                                              " has no ray queries (VK_KHR_ray_query); --rays walk needs none"};
    const bool is_gpu = candidate.properties.deviceType != VK_PHYSICAL_DEVICE_TYPE_CPU;
    return traversal == Traversal::kHardware || (traversal == Traversal::kAuto && candidate.ray_queries && is_gpu);
}

std::string refusalOf(const Candidate& candidate) {
    const VkPhysicalDeviceProperties& properties = candidate.properties;
    if (properties.apiVersion < VK_API_VERSION_1_2)
        return "it has Vulkan " + versionText(properties.apiVersion) + ", but 1.2 is needed";
    if (!candidate.queue_family) return missingQueue(candidate.needs);
    if (candidate.needs.present && !candidate.swapchain) return "it cannot show pictures in a window";
    if (properties.limits.maxTexelBufferElements < kMinTexels)
        return "texel buffers hold " + std::to_string(properties.limits.maxTexelBufferElements) + " elements, but " +
               std::to_string(kMinTexels) + " are needed";
    if (!(candidate.subgroup.supportedStages & VK_SHADER_STAGE_COMPUTE_BIT))
        return "no subgroup operations in compute shaders";
    if ((candidate.subgroup.supportedOperations & kSubgroupOperations) != kSubgroupOperations)
        return "subgroup basic, vote, arithmetic and ballot operations are needed";
    if (const std::string few = missingDescriptors(properties.limits); !few.empty()) return few;
    if (!candidate.reads_texels) return "it cannot read texel buffers of 32-bit elements";
    return {};
}

std::vector<Candidate> enumerateCandidates(VkInstance instance, const QueueNeeds& needs) {
    std::uint32_t count = 0;
    check(vkEnumeratePhysicalDevices(instance, &count, nullptr), "list Vulkan devices");
    std::vector<VkPhysicalDevice> devices(count);
    check(vkEnumeratePhysicalDevices(instance, &count, devices.data()), "list Vulkan devices");
    devices.resize(count);
    std::vector<Candidate> candidates;
    for (VkPhysicalDevice device : devices) candidates.push_back(inspect(device, needs));
    return candidates;
}

const Candidate& chooseCandidate(const std::vector<Candidate>& candidates, const std::string& selector) {
    const Candidate* best = nullptr;
    for (std::size_t i = 0; i < candidates.size(); ++i) {
        const Candidate& candidate = candidates[i];
        if (!candidate.refusal.empty() || !matches(selector, candidate, i)) continue;
        if (!best || typeRank(candidate.properties.deviceType) > typeRank(best->properties.deviceType))
            best = &candidate;
    }
    if (best) return *best;
    if (candidates.empty())
        throw Error{ExitCode::kCannotRun, "no Vulkan device: the installed drivers find none (mesa-vulkan-drivers on "
                                          "Debian and Ubuntu includes one that runs on the CPU)"};
    throw Error{ExitCode::kCannotRun, "no usable Vulkan device: " + refusals(candidates, selector)};
}

std::string describeCandidate(const Candidate& candidate, std::size_t index) {
    char memory[32];
    std::snprintf(memory, sizeof memory, "%.1f GiB",
                  static_cast<double>(deviceLocalBytes(candidate.memory)) / (1 << 30));
    std::string line = numberedName(candidate, index) + ", " + typeName(candidate.properties.deviceType) + ", Vulkan " +
                       versionText(candidate.properties.apiVersion) + ", " + memory;
    if (!candidate.refusal.empty()) line += ", unusable: " + candidate.refusal;
    return line + "\n";
}

} // namespace pointrt

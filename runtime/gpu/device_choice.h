// SPDX-License-Identifier: Apache-2.0
// Enumerates Vulkan devices, finds why some are unusable, and chooses the best.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "runtime/gpu/traversal.h"
#include "runtime/gpu/vulkan.h"

namespace pointrt {

/// Descriptors of each kind that a program declares.
struct DescriptorCounts {
    std::uint32_t storage_texel_buffers = 0, uniform_texel_buffers = 0, storage_buffers = 0, uniform_buffers = 0;
};
/// The most descriptors of any program that renders, without further pages. Vulkan guarantees 4, 16, 4 and 12. Programs
/// that cast a caller's rays, and those of paged scans and pooled tiles, have more; createProgram checks these.
constexpr DescriptorCounts kRenderDescriptors{7, 18, 22, 3};

/// What the queue must support besides compute.
struct QueueNeeds {
    bool graphics = false;
    bool present = false;                                                    ///< graphics, and a swapchain
    std::function<bool(VkPhysicalDevice, std::uint32_t family)> can_present; ///< if not set, every family can
};

/// An enumerated device, with all that is needed to choose and list it.
struct Candidate {
    VkPhysicalDevice physical = VK_NULL_HANDLE;
    VkPhysicalDeviceProperties properties{};
    VkPhysicalDeviceMaintenance3Properties maintenance3{};
    VkPhysicalDeviceSubgroupProperties subgroup{};
    VkPhysicalDeviceMemoryProperties memory{};
    QueueNeeds needs;
    std::optional<std::uint32_t> queue_family; ///< the first family that supports compute and the queue's needs
    bool swapchain = false;                    ///< has VK_KHR_swapchain; set only if needs.present
    bool external_memory_host = false;
    std::uint64_t host_import_alignment = 0; ///< bytes
    bool doubles = false;                    ///< shaders may use 64-bit floats
    /// The subgroup sizes that compute programs may require (VK_EXT_subgroup_size_control); 0 if they may not.
    std::uint32_t least_subgroup = 0, largest_subgroup = 0;
    bool ray_queries = false;  ///< has kRayExtensions and their features
    bool reads_texels = false; ///< supports texel buffers in the formats of scenes
    std::string refusal;       ///< empty if usable
};

/// The extensions that ray queries need.
constexpr const char* kRayExtensions[] = {VK_KHR_RAY_QUERY_EXTENSION_NAME, VK_KHR_ACCELERATION_STRUCTURE_EXTENSION_NAME,
                                          VK_KHR_DEFERRED_HOST_OPERATIONS_EXTENSION_NAME};

/// The features of those extensions, to query or to enable.
struct RayFeatures {
    VkPhysicalDeviceBufferDeviceAddressFeatures addresses{
        VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_BUFFER_DEVICE_ADDRESS_FEATURES};
    VkPhysicalDeviceAccelerationStructureFeaturesKHR trees{
        VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_ACCELERATION_STRUCTURE_FEATURES_KHR};
    VkPhysicalDeviceRayQueryFeaturesKHR queries{VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_RAY_QUERY_FEATURES_KHR};

    RayFeatures() { addresses.bufferDeviceAddress = trees.accelerationStructure = queries.rayQuery = VK_TRUE; }
    bool all() const { return addresses.bufferDeviceAddress && trees.accelerationStructure && queries.rayQuery; }
    /// Prepends them to a chain.
    void* chainBefore(void* rest) {
        queries.pNext = rest;
        trees.pNext = &queries;
        addresses.pNext = &trees;
        return &addresses;
    }
};

/// Whether a device is to trace by ray queries. Throws Error kCannotRun if ray queries are required and it has none.
bool queriesRays(const Candidate& candidate, Traversal traversal);

std::vector<Candidate> enumerateCandidates(VkInstance instance, const QueueNeeds& needs = {});

bool hasExtension(VkPhysicalDevice physical, const char* name);

/// The subgroup size to require for programs; 0: the driver chooses. It is 32 if the driver would choose more, as AMD's
/// do, and the hardware supports 32: in a smaller subgroup, rays wait for fewer others (tests/bench/NOTES.md).
std::uint32_t subgroupSizeFor(const Candidate& candidate);

/// Why candidate is unusable; empty if it is usable. Does not read candidate.physical or refusal.
std::string refusalOf(const Candidate& candidate);

/// The best usable candidate that selector (see DeviceRequest) matches.
/// Throws Error kCannotRun with one line that names every candidate and why it was refused.
const Candidate& chooseCandidate(const std::vector<Candidate>& candidates, const std::string& selector);

/// A line of the device list, including the newline: index, name, type, API version, memory and refusal.
std::string describeCandidate(const Candidate& candidate, std::size_t index);

} // namespace pointrt

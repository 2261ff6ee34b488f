// SPDX-License-Identifier: Apache-2.0
// Which of the Vulkan devices can run the viewer, why the others cannot, and which one is best.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "runtime/gpu/vulkan.h"

namespace pointrt {

/// What the queue is for besides compute.
struct QueueNeeds {
    bool graphics = false;
    bool present = false;                                                    ///< graphics, and a swapchain
    std::function<bool(VkPhysicalDevice, std::uint32_t family)> can_present; ///< without it every family can
};

/// A device as enumerated: what choosing and listing it needs.
struct Candidate {
    VkPhysicalDevice physical = VK_NULL_HANDLE;
    VkPhysicalDeviceProperties properties{};
    VkPhysicalDeviceMaintenance3Properties maintenance3{};
    VkPhysicalDeviceSubgroupProperties subgroup{};
    VkPhysicalDeviceMemoryProperties memory{};
    QueueNeeds needs;
    std::optional<std::uint32_t> queue_family; ///< the first with compute and what needs says
    bool swapchain = false;                    ///< has VK_KHR_swapchain; looked up where needs.present
    bool external_memory_host = false;
    std::uint64_t host_import_alignment = 0; ///< bytes
    bool doubles = false;                    ///< programs may reckon in them
    bool reads_texels = false;               ///< in the formats the scene is stored in
    std::string refusal;                     ///< empty when usable
};

std::vector<Candidate> enumerateCandidates(VkInstance instance, const QueueNeeds& needs = {});

/// Why the viewer cannot run on candidate; empty when it can. Reads everything but candidate.physical and refusal.
std::string refusalOf(const Candidate& candidate);

/// The best usable candidate that selector (see DeviceRequest) means.
/// Throws Error kCannotRun with one line naming every candidate and what is wrong with it.
const Candidate& chooseCandidate(const std::vector<Candidate>& candidates, const std::string& selector);

/// A line of the device list, with its line end: index, name, type, API version, memory and refusal.
std::string describeCandidate(const Candidate& candidate, std::size_t index);

} // namespace pointrt

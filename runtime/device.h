// SPDX-License-Identifier: Apache-2.0
// Choosing a Vulkan device for compute, and the one queue everything runs on.
#pragma once

#include <cstdint>
#include <string>

#include "runtime/vulkan.h"

namespace pointrt {

struct DeviceRequest {
    std::string selector; ///< "" for the best one, an index of the list, or a part of a name in any case
    bool verbose = false;
};

/// A logical device with one compute queue. Free it with destroyDevice after everything made from it.
struct Device {
    VkInstance instance = VK_NULL_HANDLE;
    VkDebugUtilsMessengerEXT messenger = VK_NULL_HANDLE;
    VkPhysicalDevice physical = VK_NULL_HANDLE;
    VkDevice handle = VK_NULL_HANDLE;
    VkQueue queue = VK_NULL_HANDLE;
    std::uint32_t queue_family = 0;
    VkCommandPool command_pool = VK_NULL_HANDLE;
    VkFence fence = VK_NULL_HANDLE;

    std::string name;
    VkPhysicalDeviceType type = VK_PHYSICAL_DEVICE_TYPE_OTHER;
    VkPhysicalDeviceLimits limits{};
    VkPhysicalDeviceMemoryProperties memory{};
    std::uint64_t max_allocation_bytes = 0;
    std::uint32_t subgroup_size = 0;
    bool unified_memory = false;             ///< CPU or integrated: its memory is the host's, so importing saves a copy
    bool external_memory_host = false;       ///< VK_EXT_external_memory_host is enabled
    std::uint64_t host_import_alignment = 0; ///< bytes, of pointers and sizes given to importHostBuffer
    PFN_vkGetMemoryHostPointerPropertiesEXT getMemoryHostPointerProperties = nullptr;
    bool verbose = false;
};

/// Opens the device that request selects; without a selector discrete comes before integrated, virtual and CPU.
/// POINTRT_VALIDATION=1 in the environment turns the Khronos validation layer on, synchronization checks included.
/// Throws Error kCannotRun with one line that names every device seen and why it was refused.
Device createDevice(const DeviceRequest& request);
void destroyDevice(Device& device);

/// A line for each device: index, name, type, API version, memory, and why it cannot be used where that is so.
/// Throws Error kCannotRun where there is no loader or no driver at all.
std::string listDevices();

/// Validation messages of warning or above since the process started; each was printed to stderr.
std::uint64_t validationMessages();

/// A command buffer ready for recording, to be given to submitAndWait or freed with the device's command pool.
VkCommandBuffer beginCommands(Device& device);
/// Ends, submits and frees commands, and returns when the device is done and its writes are seen by the host and by
/// later commands. Throws Error kCannotRun (lost device).
void submitAndWait(Device& device, VkCommandBuffer commands);

} // namespace pointrt

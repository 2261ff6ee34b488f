// SPDX-License-Identifier: Apache-2.0
// Choosing a Vulkan device for compute (and a window, where one is asked for), and the one queue everything runs on.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <mutex>
#include <string>
#include <vector>

#include "runtime/gpu/vulkan.h"

namespace pointrt {

class ProgramStore;

struct DeviceRequest {
    std::string selector; ///< "" for the best one, an index of the list, or a part of a name in any case
    bool verbose = false;
    bool graphics = false; ///< the queue draws besides computing
    /// What the window system needs. With any, the queue also presents, and the device has VK_KHR_swapchain.
    std::vector<const char*> instance_extensions;
    /// Whether a queue family reaches the window's display; without it all of them are taken to.
    std::function<bool(VkInstance, VkPhysicalDevice, std::uint32_t queue_family)> can_present;
    std::uint32_t page_bits_most = 31; ///< makes Device::page_bits no larger: tests have many pages with small scenes
};

/// A logical device with one compute queue. Free it with destroyDevice after everything made from it.
struct Device {
    VkInstance instance = VK_NULL_HANDLE;
    VkDebugUtilsMessengerEXT messenger = VK_NULL_HANDLE;
    VkPhysicalDevice physical = VK_NULL_HANDLE;
    VkDevice handle = VK_NULL_HANDLE;
    VkQueue queue = VK_NULL_HANDLE;
    std::shared_ptr<std::mutex> queue_mutex; ///< null until a workerDevice shares the queue
    std::uint32_t queue_family = 0;
    VkCommandPool command_pool = VK_NULL_HANDLE;
    VkFence fence = VK_NULL_HANDLE;

    std::string name;
    VkPhysicalDeviceType type = VK_PHYSICAL_DEVICE_TYPE_OTHER;
    VkPhysicalDeviceLimits limits{};
    VkPhysicalDeviceMemoryProperties memory{};
    std::uint64_t max_allocation_bytes = 0;
    std::uint32_t page_bits = 0; ///< log2 of the texels in a page (paged_buffer.h)
    std::uint32_t subgroup_size = 0;
    bool unified_memory = false;             ///< CPU or integrated: its memory is the host's, so importing saves a copy
    bool doubles = false;                    ///< programs may reckon in them
    bool external_memory_host = false;       ///< VK_EXT_external_memory_host is enabled
    std::uint64_t host_import_alignment = 0; ///< bytes, of pointers and sizes given to importHostBuffer
    PFN_vkGetMemoryHostPointerPropertiesEXT getMemoryHostPointerProperties = nullptr;
    std::shared_ptr<ProgramStore> programs; ///< what createProgram built, shared with workers
    bool verbose = false;
};

/// Opens the device that request selects; without a selector discrete comes before integrated, virtual and CPU.
/// POINTRT_VALIDATION=1 in the environment turns the Khronos validation layer on, synchronization checks included.
/// Throws Error kCannotRun with one line that names every device seen and why it was refused.
Device createDevice(const DeviceRequest& request);
void destroyDevice(Device& device);

/// The same device for another thread: it shares the queue, whose users then take turns, and has a command pool and a
/// fence of its own. What is made through one may be used and freed through the other. Call it while no other thread
/// uses device; free the result with destroyWorkerDevice before device.
Device workerDevice(Device& device);
void destroyWorkerDevice(Device& worker);

/// Keeps other threads off the queue while it lives; for every call that takes device.queue.
std::unique_lock<std::mutex> lockQueue(Device& device);

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

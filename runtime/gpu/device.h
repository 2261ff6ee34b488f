// SPDX-License-Identifier: Apache-2.0
// A Vulkan device for compute, and for a window on request, with the one queue that everything runs on.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <vector>

#include "runtime/gpu/traversal.h"
#include "runtime/gpu/vulkan.h"

namespace pointrt {

class MemoryPool;
class PipelineCache;
class ProgramStore;
class Staging;
class TexelPool;

struct DeviceRequest {
    std::string selector; ///< "" for the best device, an index in listDevices, or part of a name, ignoring case
    bool verbose = false;
    bool graphics = false; ///< the queue must support graphics
    /// Extensions that the window system needs. If there are any, the queue must be able to present and the device must
    /// have VK_KHR_swapchain.
    std::vector<const char*> instance_extensions;
    /// Whether a queue family can present to the window's display. If not set, all families can.
    std::function<bool(VkInstance, VkPhysicalDevice, std::uint32_t queue_family)> can_present;
    Traversal traversal = Traversal::kWalk;
    std::uint32_t page_bits_most = 31; ///< limit for Device::page_bits, for tests with many pages in small scenes
};

/// The submissions to a queue, numbered from 1 in order. The semaphore's value is the number of the last completed
/// submission.
struct Timeline {
    VkSemaphore semaphore = VK_NULL_HANDLE;
    std::uint64_t submitted = 0; ///< guarded by the queue's mutex
    /// Commands to run at the start of the next submission; also guarded by the queue's mutex.
    std::vector<VkCommandBuffer> held;
};

/// Commands that the device may still be running.
struct SubmittedCommands {
    VkCommandBuffer commands = VK_NULL_HANDLE;
    std::uint64_t number = 0; ///< number of the submission
};

/// Frames in flight: the host records a frame while the device renders the previous one.
constexpr std::uint32_t kFramesInFlight = 2;

/// Functions of ray queries; null unless Device::queries_rays.
struct RayFunctions {
    PFN_vkGetBufferDeviceAddress addressOf = nullptr;
    PFN_vkGetAccelerationStructureDeviceAddressKHR addressOfTree = nullptr;
    PFN_vkGetAccelerationStructureBuildSizesKHR sizesOf = nullptr;
    PFN_vkCreateAccelerationStructureKHR createTree = nullptr;
    PFN_vkDestroyAccelerationStructureKHR destroyTree = nullptr;
    PFN_vkCmdBuildAccelerationStructuresKHR build = nullptr;
};

/// A logical device with one compute queue. Free it with destroyDevice after everything made from it.
struct Device {
    VkInstance instance = VK_NULL_HANDLE;
    VkDebugUtilsMessengerEXT messenger = VK_NULL_HANDLE;
    VkPhysicalDevice physical = VK_NULL_HANDLE;
    VkDevice handle = VK_NULL_HANDLE;
    VkQueue queue = VK_NULL_HANDLE;
    std::shared_ptr<std::mutex> queue_mutex; ///< shared with workers
    std::uint32_t queue_family = 0;
    std::shared_ptr<Timeline> timeline; ///< shared with workers
    VkCommandPool command_pool = VK_NULL_HANDLE;
    std::vector<SubmittedCommands> in_flight; ///< submissions of this thread, oldest first

    std::string name;
    VkPhysicalDeviceType type = VK_PHYSICAL_DEVICE_TYPE_OTHER;
    VkPhysicalDeviceLimits limits{};
    VkPhysicalDeviceMemoryProperties memory{};
    std::uint64_t max_allocation_bytes = 0;
    std::uint32_t page_bits = 0; ///< log2 of the texels in a page (paged_buffer.h)
    std::uint32_t subgroup_size = 0;
    bool sets_subgroup_size = false; ///< whether programs set subgroup_size (VK_EXT_subgroup_size_control)
    bool unified_memory = false;     ///< CPU or integrated GPU: memory is the host's, so importing saves a copy
    bool doubles = false;            ///< shaders may use 64-bit floats
    bool queries_rays = false; ///< whether DeviceRequest::traversal requests ray queries and the device supports them
    RayFunctions rays;
    bool external_memory_host = false;       ///< VK_EXT_external_memory_host is enabled
    std::uint64_t host_import_alignment = 0; ///< bytes, for pointers and sizes given to importHostBuffer
    PFN_vkGetMemoryHostPointerPropertiesEXT getMemoryHostPointerProperties = nullptr;
    PFN_vkSetDebugUtilsObjectNameEXT setObjectName = nullptr; ///< null unless debug names are on (nameObject)
    PFN_vkCmdBeginDebugUtilsLabelEXT beginLabel = nullptr;    ///< null unless debug names are on (CommandLabel)
    PFN_vkCmdEndDebugUtilsLabelEXT endLabel = nullptr;        ///< null unless debug names are on (CommandLabel)
    std::shared_ptr<PipelineCache> pipelines;                 ///< shared with workers
    std::shared_ptr<MemoryPool> memory_pool;                  ///< for all buffers; shared with workers
    std::shared_ptr<TexelPool> texel_pool;                    ///< for the tiles of sets; shared with workers
    std::shared_ptr<Staging> staging;                         ///< of this thread only
    std::shared_ptr<ProgramStore> programs; ///< programs that createProgram built, shared with workers
    bool verbose = false;
};

/// Opens the selected device. Without a selector discrete GPUs come before integrated ones, virtual ones and CPUs.
/// POINTRT_VALIDATION=1 in the environment enables the Khronos validation layer with synchronization checks.
/// Throws Error kCannotRun with one line that names every device found and why it was refused.
Device createDevice(const DeviceRequest& request);
void destroyDevice(Device& device);

/// The same device for another thread: it shares the queue, under a mutex, and has its own command pool and staging.
/// First waits for the submissions of device, since the thread may change the objects that they use. Objects created
/// through either device may be used and freed through the other. Free the worker with destroyWorkerDevice, before
/// device.
Device workerDevice(const Device& device);
void destroyWorkerDevice(Device& worker);

/// Hold the lock during every call that takes device.queue.
std::unique_lock<std::mutex> lockQueue(Device& device);

/// One line per device: index, name, type, API version, memory, and the reason if it cannot be used. Throws Error
/// kCannotRun if there is no Vulkan loader or no driver.
std::string listDevices();

/// Validation messages of severity warning or above since the process started; each was printed to stderr.
std::uint64_t validationMessages();

/// Names a Vulkan object for validation messages and debuggers (VK_EXT_debug_utils). Does nothing unless
/// POINTRT_VALIDATION is set or the environment enables a layer, such as a frame debugger's.
template <typename Handle>
void nameObject(const Device& device, VkObjectType type, Handle handle, const char* name) {
    if (!device.setObjectName || !handle) return;
    VkDebugUtilsObjectNameInfoEXT info{VK_STRUCTURE_TYPE_DEBUG_UTILS_OBJECT_NAME_INFO_EXT};
    info.objectType = type;
    info.objectHandle = reinterpret_cast<std::uint64_t>(handle);
    info.pObjectName = name;
    device.setObjectName(device.handle, &info); // fails only if out of memory, which the next call reports
}

/// Labels the commands recorded during its lifetime, for debuggers, if object names are on (nameObject). Does nothing
/// without commands.
class CommandLabel {
public:
    CommandLabel(const Device& device, VkCommandBuffer commands, const char* name)
        : end_(commands ? device.endLabel : nullptr), commands_(commands) {
        VkDebugUtilsLabelEXT label{VK_STRUCTURE_TYPE_DEBUG_UTILS_LABEL_EXT};
        label.pLabelName = name;
        if (end_) device.beginLabel(commands, &label);
    }
    ~CommandLabel() {
        if (end_) end_(commands_);
    }
    CommandLabel(const CommandLabel&) = delete;
    CommandLabel& operator=(const CommandLabel&) = delete;

private:
    PFN_vkCmdEndDebugUtilsLabelEXT end_;
    VkCommandBuffer commands_;
};

/// A command buffer in the recording state, for submit.
/// @param name for debuggers
VkCommandBuffer beginCommands(Device& device, const char* name = "commands");
/// Semaphores for commands that draw to an image of the display.
struct DisplaySync {
    VkSemaphore acquired = VK_NULL_HANDLE; ///< waited for before the image is written
    VkSemaphore drawn = VK_NULL_HANDLE;    ///< signalled when the image can be shown
};

/// Ends and submits commands, which run after all earlier submissions. When they are done, their writes are visible to
/// the host and to later commands. Returns the number of the submission. Throws Error kCannotRun (device lost).
std::uint64_t submit(Device& device, VkCommandBuffer commands, const std::optional<DisplaySync>& display = {});
/// When commands are submitted: at once, or with the next submission (submitWithNext).
enum class Submission { kNow, kWithNext };

/// Ends commands and leaves them to the next submission by any thread, or to the next wait for them: a submission costs
/// the host tens of microseconds. Returns the number of the submission that will include them.
std::uint64_t submitWithNext(Device& device, VkCommandBuffer commands);
/// Whether a submission is done.
bool isDone(const Device& device, std::uint64_t submission);
/// Waits for a submission; returns at once for 0. Throws Error kCannotRun (device lost).
void waitFor(const Device& device, std::uint64_t submission);
/// Waits for everything that this thread has submitted. Throws Error kCannotRun (device lost).
void waitForSubmitted(const Device& device);
/// Waits before objects are freed; returns at once if the device is lost, since it runs nothing any more.
void finishSubmitted(const Device& device) noexcept;
void submitAndWait(Device& device, VkCommandBuffer commands);

} // namespace pointrt

// SPDX-License-Identifier: Apache-2.0
#include "runtime/gpu/device.h"

#include <algorithm>
#include <atomic>
#include <bit>
#include <cstdio>
#include <cstring>
#include <vector>

#include "format/base/error.h"
#include "format/os/environment.h"
#include "runtime/gpu/device_choice.h"
#include "runtime/gpu/memory_pool.h"
#include "runtime/gpu/pipeline_cache.h"
#include "runtime/gpu/program_store.h"
#include "runtime/gpu/staging.h"
#include "runtime/gpu/texel_pool.h"
#include "runtime/util/on_error.h"

namespace pointrt {
namespace {

constexpr const char* kValidationLayer = "VK_LAYER_KHRONOS_validation";
constexpr std::uint32_t kApiVersion = VK_API_VERSION_1_2;

std::atomic<std::uint64_t> validation_messages = 0;

VKAPI_ATTR VkBool32 VKAPI_CALL onValidationMessage(VkDebugUtilsMessageSeverityFlagBitsEXT,
                                                   VkDebugUtilsMessageTypeFlagsEXT,
                                                   const VkDebugUtilsMessengerCallbackDataEXT* data, void*) {
    ++validation_messages;
    std::fprintf(stderr, "Vulkan validation: %s\n", data->pMessage);
    return VK_FALSE;
}

VkDebugUtilsMessengerCreateInfoEXT messengerInfo() {
    VkDebugUtilsMessengerCreateInfoEXT info{VK_STRUCTURE_TYPE_DEBUG_UTILS_MESSENGER_CREATE_INFO_EXT};
    info.messageSeverity =
        VK_DEBUG_UTILS_MESSAGE_SEVERITY_WARNING_BIT_EXT | VK_DEBUG_UTILS_MESSAGE_SEVERITY_ERROR_BIT_EXT;
    // not GENERAL: with that type, the loader reports drivers of other vendors that find no hardware
    info.messageType = VK_DEBUG_UTILS_MESSAGE_TYPE_VALIDATION_BIT_EXT | VK_DEBUG_UTILS_MESSAGE_TYPE_PERFORMANCE_BIT_EXT;
    info.pfnUserCallback = onValidationMessage;
    return info;
}

bool isSet(const char* variable) {
    const std::string value = environmentVariable(variable);
    return !value.empty() && value != "0";
}

bool wantsValidation() { return isSet("POINTRT_VALIDATION"); }

/// Variables by which RenderDoc and the Vulkan loader enable layers.
constexpr const char* kLayerVariables[] = {"ENABLE_VULKAN_RENDERDOC_CAPTURE", "VK_INSTANCE_LAYERS",
                                           "VK_LOADER_LAYERS_ENABLE"};

bool wantsDebugNames() {
    return wantsValidation() || std::any_of(std::begin(kLayerVariables), std::end(kLayerVariables), isSet);
}

bool hasDebugUtils() {
    std::uint32_t count = 0;
    if (vkEnumerateInstanceExtensionProperties(nullptr, &count, nullptr) != VK_SUCCESS) return false;
    std::vector<VkExtensionProperties> extensions(count);
    if (vkEnumerateInstanceExtensionProperties(nullptr, &count, extensions.data()) != VK_SUCCESS) return false;
    return std::any_of(extensions.begin(), extensions.end(), [](const VkExtensionProperties& each) {
        return std::strcmp(each.extensionName, VK_EXT_DEBUG_UTILS_EXTENSION_NAME) == 0;
    });
}

void requireValidationLayer() {
    std::uint32_t count = 0;
    check(vkEnumerateInstanceLayerProperties(&count, nullptr), "list Vulkan layers");
    std::vector<VkLayerProperties> layers(count);
    check(vkEnumerateInstanceLayerProperties(&count, layers.data()), "list Vulkan layers");
    for (const VkLayerProperties& layer : layers)
        if (std::strcmp(layer.layerName, kValidationLayer) == 0) return;
    throw Error{ExitCode::kCannotRun, std::string("POINTRT_VALIDATION is set, but ") + kValidationLayer +
                                          " is not installed (Debian, Ubuntu: vulkan-validationlayers)"};
}

void requireLoaderVersion() {
    std::uint32_t version = 0;
    check(vkEnumerateInstanceVersion(&version), "query the Vulkan loader's version");
    if (version < kApiVersion) throw Error{ExitCode::kCannotRun, "the Vulkan loader is older than Vulkan 1.2"};
}

VkInstance createInstance(std::vector<const char*> extensions) {
    loadVulkan();
    requireLoaderVersion();
    VkApplicationInfo application{VK_STRUCTURE_TYPE_APPLICATION_INFO};
    application.pApplicationName = "pointrt";
    application.apiVersion = kApiVersion;
    VkInstanceCreateInfo info{VK_STRUCTURE_TYPE_INSTANCE_CREATE_INFO};
    info.pApplicationInfo = &application;

    const VkValidationFeatureEnableEXT synchronization = VK_VALIDATION_FEATURE_ENABLE_SYNCHRONIZATION_VALIDATION_EXT;
    VkDebugUtilsMessengerCreateInfoEXT messenger = messengerInfo();
    VkValidationFeaturesEXT features{VK_STRUCTURE_TYPE_VALIDATION_FEATURES_EXT};
    if (wantsValidation()) {
        requireValidationLayer();
        features.enabledValidationFeatureCount = 1;
        features.pEnabledValidationFeatures = &synchronization;
        messenger.pNext = &features;
        info.pNext = &messenger;
        info.enabledLayerCount = 1;
        info.ppEnabledLayerNames = &kValidationLayer;
    }
    // the validation layer has the extension, even if the loader does not list it
    if (wantsValidation() || (wantsDebugNames() && hasDebugUtils()))
        extensions.push_back(VK_EXT_DEBUG_UTILS_EXTENSION_NAME);
    info.enabledExtensionCount = static_cast<std::uint32_t>(extensions.size());
    info.ppEnabledExtensionNames = extensions.data();
    VkInstance instance = VK_NULL_HANDLE;
    const VkResult result = vkCreateInstance(&info, nullptr, &instance);
    if (result == VK_ERROR_INCOMPATIBLE_DRIVER)
        throw Error{ExitCode::kCannotRun, "no Vulkan driver: install one (Debian, Ubuntu: mesa-vulkan-drivers, which "
                                          "also runs without a GPU)"};
    if (result == VK_ERROR_EXTENSION_NOT_PRESENT)
        throw Error{ExitCode::kCannotRun, "no Vulkan driver here can show a window; -o FILE renders without one"};
    check(result, "create a Vulkan instance");
    return instance;
}

/// log2 of the largest page, a power of two texels, that fits for every texel format.
std::uint32_t pageBits(const Device& device) {
    constexpr std::uint64_t kLargestTexel = 16; // bytes
    const std::uint64_t texels =
        std::min<std::uint64_t>(device.limits.maxTexelBufferElements, device.max_allocation_bytes / kLargestTexel);
    return static_cast<std::uint32_t>(std::bit_width(texels)) - 1;
}

void describe(const Candidate& candidate, Device& device) {
    device.physical = candidate.physical;
    device.queue_family = *candidate.queue_family;
    device.name = candidate.properties.deviceName;
    device.type = candidate.properties.deviceType;
    device.limits = candidate.properties.limits;
    device.memory = candidate.memory;
    device.max_allocation_bytes = candidate.maintenance3.maxMemoryAllocationSize;
    device.page_bits = pageBits(device);
    device.sets_subgroup_size = subgroupSizeFor(candidate) != 0;
    device.subgroup_size = device.sets_subgroup_size ? subgroupSizeFor(candidate) : candidate.subgroup.subgroupSize;
    device.unified_memory =
        device.type == VK_PHYSICAL_DEVICE_TYPE_CPU || device.type == VK_PHYSICAL_DEVICE_TYPE_INTEGRATED_GPU;
    device.doubles = candidate.doubles;
    device.external_memory_host = candidate.external_memory_host;
    device.host_import_alignment = candidate.host_import_alignment;
}

std::vector<const char*> deviceExtensions(const Device& device, const DeviceRequest& request) {
    std::vector<const char*> extensions;
    if (device.external_memory_host) extensions.push_back(VK_EXT_EXTERNAL_MEMORY_HOST_EXTENSION_NAME);
    if (device.sets_subgroup_size) extensions.push_back(VK_EXT_SUBGROUP_SIZE_CONTROL_EXTENSION_NAME);
    if (device.queries_rays) extensions.insert(extensions.end(), std::begin(kRayExtensions), std::end(kRayExtensions));
    if (!request.instance_extensions.empty()) extensions.push_back(VK_KHR_SWAPCHAIN_EXTENSION_NAME);
    return extensions;
}

/// Creates the objects that each thread has for itself.
void createThreadObjects(Device& device) {
    VkCommandPoolCreateInfo pool{VK_STRUCTURE_TYPE_COMMAND_POOL_CREATE_INFO};
    pool.flags = VK_COMMAND_POOL_CREATE_RESET_COMMAND_BUFFER_BIT;
    pool.queueFamilyIndex = device.queue_family;
    check(vkCreateCommandPool(device.handle, &pool, nullptr, &device.command_pool), "create a command pool");
    device.staging = std::make_shared<Staging>();
}

/// Waits for this thread's submissions first, unless the device is lost.
void destroyThreadObjects(Device& device) {
    if (!device.command_pool) return;
    finishSubmitted(device);
    device.in_flight.clear();
    if (device.staging) device.staging->clear(device);
    vkDestroyCommandPool(device.handle, device.command_pool, nullptr);
    device.command_pool = VK_NULL_HANDLE;
}

void createTimeline(Device& device) {
    device.timeline = std::make_shared<Timeline>();
    VkSemaphoreTypeCreateInfo type{VK_STRUCTURE_TYPE_SEMAPHORE_TYPE_CREATE_INFO};
    type.semaphoreType = VK_SEMAPHORE_TYPE_TIMELINE;
    const VkSemaphoreCreateInfo info{VK_STRUCTURE_TYPE_SEMAPHORE_CREATE_INFO, &type, 0};
    check(vkCreateSemaphore(device.handle, &info, nullptr, &device.timeline->semaphore), "create a semaphore");
}

/// Leaves the functions null if the instance has no VK_EXT_debug_utils.
void loadDebugFunctions(Device& device) {
    device.setObjectName = reinterpret_cast<PFN_vkSetDebugUtilsObjectNameEXT>(
        vkGetInstanceProcAddr(device.instance, "vkSetDebugUtilsObjectNameEXT"));
    device.beginLabel = reinterpret_cast<PFN_vkCmdBeginDebugUtilsLabelEXT>(
        vkGetInstanceProcAddr(device.instance, "vkCmdBeginDebugUtilsLabelEXT"));
    device.endLabel = reinterpret_cast<PFN_vkCmdEndDebugUtilsLabelEXT>(
        vkGetInstanceProcAddr(device.instance, "vkCmdEndDebugUtilsLabelEXT"));
}

void loadRayFunctions(Device& device) {
    const auto load = [&](auto& function, const char* name) {
        function =
            reinterpret_cast<std::remove_reference_t<decltype(function)>>(vkGetDeviceProcAddr(device.handle, name));
    };
    load(device.rays.addressOf, "vkGetBufferDeviceAddress");
    load(device.rays.addressOfTree, "vkGetAccelerationStructureDeviceAddressKHR");
    load(device.rays.sizesOf, "vkGetAccelerationStructureBuildSizesKHR");
    load(device.rays.createTree, "vkCreateAccelerationStructureKHR");
    load(device.rays.destroyTree, "vkDestroyAccelerationStructureKHR");
    load(device.rays.build, "vkCmdBuildAccelerationStructuresKHR");
}

void createLogicalDevice(Device& device, const DeviceRequest& request) {
    const float priority = 1;
    VkDeviceQueueCreateInfo queue{VK_STRUCTURE_TYPE_DEVICE_QUEUE_CREATE_INFO};
    queue.queueFamilyIndex = device.queue_family;
    queue.queueCount = 1;
    queue.pQueuePriorities = &priority;
    const std::vector<const char*> extensions = deviceExtensions(device, request);
    VkPhysicalDeviceFeatures features{};
    features.shaderFloat64 = device.doubles;
    // every device supports it; without it, damaged files whose indices are out of range would crash GPUs
    features.robustBufferAccess = device.type != VK_PHYSICAL_DEVICE_TYPE_CPU;
    // every Vulkan 1.2 device supports them
    VkPhysicalDeviceTimelineSemaphoreFeatures timelines{VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_TIMELINE_SEMAPHORE_FEATURES};
    timelines.timelineSemaphore = VK_TRUE;
    VkPhysicalDeviceSubgroupSizeControlFeaturesEXT subgroups{
        VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_SUBGROUP_SIZE_CONTROL_FEATURES_EXT};
    subgroups.subgroupSizeControl = VK_TRUE;
    if (device.sets_subgroup_size) timelines.pNext = &subgroups;
    RayFeatures rays;
    if (device.queries_rays) timelines.pNext = rays.chainBefore(timelines.pNext);
    VkDeviceCreateInfo info{VK_STRUCTURE_TYPE_DEVICE_CREATE_INFO, &timelines};
    info.pEnabledFeatures = &features;
    info.queueCreateInfoCount = 1;
    info.pQueueCreateInfos = &queue;
    info.enabledExtensionCount = static_cast<std::uint32_t>(extensions.size());
    info.ppEnabledExtensionNames = extensions.data();
    check(vkCreateDevice(device.physical, &info, nullptr, &device.handle), "open the Vulkan device");
    vkGetDeviceQueue(device.handle, device.queue_family, 0, &device.queue);
    if (device.external_memory_host)
        device.getMemoryHostPointerProperties = reinterpret_cast<PFN_vkGetMemoryHostPointerPropertiesEXT>(
            vkGetDeviceProcAddr(device.handle, "vkGetMemoryHostPointerPropertiesEXT"));
    if (device.queries_rays) loadRayFunctions(device);
    if (wantsDebugNames()) loadDebugFunctions(device);
    device.queue_mutex = std::make_shared<std::mutex>();
    device.memory_pool = std::make_shared<MemoryPool>();
    device.texel_pool = std::make_shared<TexelPool>();
    createTimeline(device);
    device.pipelines = std::make_shared<PipelineCache>();
    device.pipelines->open(device);
    createThreadObjects(device);
}

QueueNeeds queueNeeds(const Device& device, const DeviceRequest& request) {
    QueueNeeds needs;
    needs.graphics = request.graphics;
    needs.present = !request.instance_extensions.empty();
    if (request.can_present)
        needs.can_present = [&](VkPhysicalDevice physical, std::uint32_t family) {
            return request.can_present(device.instance, physical, family);
        };
    return needs;
}

void createMessenger(Device& device) {
    if (!wantsValidation()) return;
    const auto create = reinterpret_cast<PFN_vkCreateDebugUtilsMessengerEXT>(
        vkGetInstanceProcAddr(device.instance, "vkCreateDebugUtilsMessengerEXT"));
    const VkDebugUtilsMessengerCreateInfoEXT info = messengerInfo();
    check(create(device.instance, &info, nullptr, &device.messenger), "create the validation messenger");
}

} // namespace

Device createDevice(const DeviceRequest& request) {
    Device device;
    const OnError undo([&] { destroyDevice(device); });
    device.instance = createInstance(request.instance_extensions);
    createMessenger(device);
    device.verbose = request.verbose;
    const QueueNeeds needs = queueNeeds(device, request);
    if (needs.present) loadWindowFunctions(device.instance);
    const std::vector<Candidate> candidates = enumerateCandidates(device.instance, needs);
    const Candidate& chosen = chooseCandidate(candidates, request.selector);
    describe(chosen, device);
    device.queries_rays = queriesRays(chosen, request.traversal);
    device.page_bits = std::min(device.page_bits, request.page_bits_most);
    createLogicalDevice(device, request);
    device.programs = std::make_shared<ProgramStore>();
    if (device.verbose)
        std::fprintf(stderr, "device: %s, subgroups of %u, %s\n", device.name.c_str(), device.subgroup_size,
                     device.external_memory_host ? "can import host memory" : "cannot import host memory");
    return device;
}

void destroyDevice(Device& device) {
    if (device.handle) {
        vkDeviceWaitIdle(device.handle);
        if (device.programs) device.programs->clear(device);
        if (device.pipelines) device.pipelines->close(device);
        destroyThreadObjects(device);
        if (device.texel_pool) device.texel_pool->clear(device);
        if (device.memory_pool) device.memory_pool->clear(device);
        if (device.timeline) vkDestroySemaphore(device.handle, device.timeline->semaphore, nullptr);
        vkDestroyDevice(device.handle, nullptr);
    }
    if (device.messenger) {
        const auto destroy = reinterpret_cast<PFN_vkDestroyDebugUtilsMessengerEXT>(
            vkGetInstanceProcAddr(device.instance, "vkDestroyDebugUtilsMessengerEXT"));
        destroy(device.instance, device.messenger, nullptr);
    }
    if (device.instance) vkDestroyInstance(device.instance, nullptr);
    device = {};
}

Device workerDevice(const Device& device) {
    waitForSubmitted(device);
    Device worker = device;
    worker.command_pool = VK_NULL_HANDLE;
    worker.in_flight.clear();
    worker.staging.reset();
    const OnError undo([&] { destroyWorkerDevice(worker); });
    createThreadObjects(worker);
    return worker;
}

void destroyWorkerDevice(Device& worker) {
    if (worker.handle) destroyThreadObjects(worker);
    worker = {};
}

std::string listDevices() {
    const VkInstance instance = createInstance({});
    std::string text;
    try {
        const std::vector<Candidate> candidates = enumerateCandidates(instance);
        for (std::size_t i = 0; i < candidates.size(); ++i) text += describeCandidate(candidates[i], i);
    } catch (...) {
        vkDestroyInstance(instance, nullptr);
        throw;
    }
    vkDestroyInstance(instance, nullptr);
    return text;
}

std::uint64_t validationMessages() { return validation_messages; }

} // namespace pointrt

// SPDX-License-Identifier: Apache-2.0
#include "runtime/gpu/vulkan.h"

#include <string>

#include "format/base/error.h"
#include "format/os/library.h"

namespace pointrt {

#define POINTRT_DEFINE_VULKAN(name) PFN_##name name = nullptr;
POINTRT_VULKAN_FUNCTIONS(POINTRT_DEFINE_VULKAN)
POINTRT_VULKAN_WINDOW_FUNCTIONS(POINTRT_DEFINE_VULKAN)
#undef POINTRT_DEFINE_VULKAN

namespace {

constexpr LibraryName kVulkan{"libvulkan.so.1", "vulkan-1.dll"};
constexpr SystemWords kAdvice{"install it and a driver (Debian, Ubuntu: libvulkan1 mesa-vulkan-drivers)",
                              "install the graphics card's driver, which has it"};

std::string loaderName() { return std::string("the Vulkan loader (") + kVulkan.here() + ")"; }

template <typename Function>
void loadFunction(void* library, const char* name, Function& function) {
    if (!findFunction(library, name, function))
        throw Error{ExitCode::kCannotRun, loaderName() + " is too old: it lacks " + name};
}

template <typename Function>
void loadInstanceFunction(VkInstance instance, const char* name, Function& function) {
    function = reinterpret_cast<Function>(vkGetInstanceProcAddr(instance, name));
    if (!function)
        throw Error{ExitCode::kCannotRun,
                    loaderName() + " lacks " + name + ", which a window needs; -o FILE renders without one"};
}

void* openVulkan() {
    void* opened = openLibrary(kVulkan);
    if (!opened)
        throw Error{ExitCode::kCannotRun, std::string("no Vulkan loader (") + kVulkan.here() + "): " + kAdvice.here()};
#define POINTRT_LOAD_VULKAN(name) loadFunction(opened, #name, name);
    POINTRT_VULKAN_FUNCTIONS(POINTRT_LOAD_VULKAN)
#undef POINTRT_LOAD_VULKAN
    return opened;
}

} // namespace

void loadVulkan() {
    [[maybe_unused]] static void* const library =
        openVulkan(); // initialised once, thread-safe; tried again if it threw
}

void loadWindowFunctions(VkInstance instance) {
#define POINTRT_LOAD_VULKAN(name) loadInstanceFunction(instance, #name, name);
    POINTRT_VULKAN_WINDOW_FUNCTIONS(POINTRT_LOAD_VULKAN)
#undef POINTRT_LOAD_VULKAN
}

std::string resultName(VkResult result) {
#define POINTRT_RESULT(name)                                                                                           \
    case name:                                                                                                         \
        return #name;
    switch (result) {
        POINTRT_RESULT(VK_SUCCESS)
        POINTRT_RESULT(VK_NOT_READY)
        POINTRT_RESULT(VK_TIMEOUT)
        POINTRT_RESULT(VK_INCOMPLETE)
        POINTRT_RESULT(VK_ERROR_OUT_OF_HOST_MEMORY)
        POINTRT_RESULT(VK_ERROR_OUT_OF_DEVICE_MEMORY)
        POINTRT_RESULT(VK_ERROR_INITIALIZATION_FAILED)
        POINTRT_RESULT(VK_ERROR_DEVICE_LOST)
        POINTRT_RESULT(VK_ERROR_MEMORY_MAP_FAILED)
        POINTRT_RESULT(VK_ERROR_LAYER_NOT_PRESENT)
        POINTRT_RESULT(VK_ERROR_EXTENSION_NOT_PRESENT)
        POINTRT_RESULT(VK_ERROR_FEATURE_NOT_PRESENT)
        POINTRT_RESULT(VK_ERROR_INCOMPATIBLE_DRIVER)
        POINTRT_RESULT(VK_ERROR_TOO_MANY_OBJECTS)
        POINTRT_RESULT(VK_ERROR_FORMAT_NOT_SUPPORTED)
        POINTRT_RESULT(VK_ERROR_FRAGMENTED_POOL)
        POINTRT_RESULT(VK_ERROR_UNKNOWN)
        POINTRT_RESULT(VK_ERROR_OUT_OF_POOL_MEMORY)
        POINTRT_RESULT(VK_ERROR_INVALID_EXTERNAL_HANDLE)
        POINTRT_RESULT(VK_ERROR_FRAGMENTATION)
        POINTRT_RESULT(VK_SUBOPTIMAL_KHR)
        POINTRT_RESULT(VK_ERROR_OUT_OF_DATE_KHR)
        POINTRT_RESULT(VK_ERROR_SURFACE_LOST_KHR)
        POINTRT_RESULT(VK_ERROR_NATIVE_WINDOW_IN_USE_KHR)
        POINTRT_RESULT(VK_ERROR_INVALID_OPAQUE_CAPTURE_ADDRESS)
    default:
        return "VkResult " + std::to_string(static_cast<int>(result));
    }
#undef POINTRT_RESULT
}

void check(VkResult result, const char* what) {
    if (result == VK_SUCCESS) return;
    const std::string message = std::string("cannot ") + what + ": " + resultName(result);
    if (result == VK_ERROR_DEVICE_LOST) throw DeviceLost(ExitCode::kCannotRun, message);
    throw Error(ExitCode::kCannotRun, message);
}

} // namespace pointrt

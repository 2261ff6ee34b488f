// SPDX-License-Identifier: Apache-2.0
#include "runtime/window/platform/swapchain.h"

#include <algorithm>
#include <initializer_list>
#include <limits>
#include <utility>

#include "format/base/error.h"
#include "runtime/window/platform/image.h"

namespace pointrt {
namespace {

// Three frames at 30 Hz: if no image is free after that, the window is not visible.
constexpr std::uint64_t kAcquireNanoseconds = 100'000'000;
constexpr VkImageUsageFlags kUsage = VK_IMAGE_USAGE_TRANSFER_DST_BIT | VK_IMAGE_USAGE_COLOR_ATTACHMENT_BIT;

/// Like check, but with a separate message for lost surfaces.
void checkWindow(VkResult result, const char* what) {
    if (result == VK_ERROR_SURFACE_LOST_KHR)
        throw Error{ExitCode::kCannotRun, "the display connection was lost (VK_ERROR_SURFACE_LOST_KHR)"};
    check(result, what);
}

/// Calls a Vulkan enumeration function for a surface.
template <typename Item>
std::vector<Item> listOf(Device& device, VkSurfaceKHR surface, const char* what,
                         VkResult (*list)(VkPhysicalDevice, VkSurfaceKHR, std::uint32_t*, Item*)) {
    std::uint32_t count = 0;
    checkWindow(list(device.physical, surface, &count, nullptr), what);
    std::vector<Item> items(count);
    checkWindow(list(device.physical, surface, &count, items.data()), what);
    return items;
}

VkFormat chooseFormat(Device& device, VkSurfaceKHR surface) {
    const auto formats = listOf(device, surface, "list the formats of a window", vkGetPhysicalDeviceSurfaceFormatsKHR);
    for (VkFormat wanted : {VK_FORMAT_B8G8R8A8_UNORM, VK_FORMAT_R8G8B8A8_UNORM})
        for (const VkSurfaceFormatKHR& format : formats)
            if (format.format == wanted && format.colorSpace == VK_COLOR_SPACE_SRGB_NONLINEAR_KHR) return wanted;
    throw Error{ExitCode::kCannotRun, "the window has no 8-bit colour format on " + device.name};
}

/// Mailbox neither waits nor tears. Without it GPUs use vertical synchronisation; CPU devices cannot afford to wait for
/// it.
VkPresentModeKHR choosePresentMode(Device& device, VkSurfaceKHR surface) {
    const auto modes =
        listOf(device, surface, "list the present modes of a window", vkGetPhysicalDeviceSurfacePresentModesKHR);
    const auto has = [&](VkPresentModeKHR mode) { return std::count(modes.begin(), modes.end(), mode) > 0; };
    if (has(VK_PRESENT_MODE_MAILBOX_KHR)) return VK_PRESENT_MODE_MAILBOX_KHR;
    if (device.type == VK_PHYSICAL_DEVICE_TYPE_CPU && has(VK_PRESENT_MODE_IMMEDIATE_KHR))
        return VK_PRESENT_MODE_IMMEDIATE_KHR;
    return VK_PRESENT_MODE_FIFO_KHR;
}

VkSurfaceCapabilitiesKHR capabilitiesOf(Device& device, VkSurfaceKHR surface) {
    VkSurfaceCapabilitiesKHR capabilities;
    checkWindow(vkGetPhysicalDeviceSurfaceCapabilitiesKHR(device.physical, surface, &capabilities),
                "query the size of a window");
    if ((capabilities.supportedUsageFlags & kUsage) != kUsage)
        throw Error{ExitCode::kCannotRun, device.name + " cannot copy pictures to this window"};
    return capabilities;
}

VkExtent2D extentFor(const VkSurfaceCapabilitiesKHR& capabilities, VkExtent2D wanted) {
    constexpr std::uint32_t kOpen = std::numeric_limits<std::uint32_t>::max();
    if (capabilities.currentExtent.width != kOpen) return capabilities.currentExtent;
    if (wanted.width == 0 || wanted.height == 0) return {};
    const VkExtent2D lo = capabilities.minImageExtent, hi = capabilities.maxImageExtent;
    return {std::clamp(wanted.width, lo.width, hi.width), std::clamp(wanted.height, lo.height, hi.height)};
}

VkCompositeAlphaFlagBitsKHR compositeAlpha(const VkSurfaceCapabilitiesKHR& capabilities) {
    const VkCompositeAlphaFlagsKHR flags = capabilities.supportedCompositeAlpha;
    if (flags & VK_COMPOSITE_ALPHA_OPAQUE_BIT_KHR) return VK_COMPOSITE_ALPHA_OPAQUE_BIT_KHR;
    return static_cast<VkCompositeAlphaFlagBitsKHR>(flags & (~flags + 1)); // the lowest bit
}

std::uint32_t imageCount(const VkSurfaceCapabilitiesKHR& capabilities) {
    const std::uint32_t count = capabilities.minImageCount + 1;
    return capabilities.maxImageCount ? std::min(count, capabilities.maxImageCount) : count;
}

VkSwapchainKHR createHandle(Device& device, const Swapchain& swapchain, const VkSurfaceCapabilitiesKHR& capabilities,
                            VkSwapchainKHR old) {
    VkSwapchainCreateInfoKHR info{VK_STRUCTURE_TYPE_SWAPCHAIN_CREATE_INFO_KHR};
    info.surface = swapchain.surface;
    info.minImageCount = imageCount(capabilities);
    info.imageFormat = swapchain.format;
    info.imageColorSpace = VK_COLOR_SPACE_SRGB_NONLINEAR_KHR;
    info.imageExtent = swapchain.extent;
    info.imageArrayLayers = 1;
    info.imageUsage = kUsage;
    info.imageSharingMode = VK_SHARING_MODE_EXCLUSIVE;
    info.preTransform = capabilities.currentTransform;
    info.compositeAlpha = compositeAlpha(capabilities);
    info.presentMode = swapchain.present_mode;
    info.clipped = VK_TRUE;
    info.oldSwapchain = old;
    VkSwapchainKHR handle = VK_NULL_HANDLE;
    checkWindow(vkCreateSwapchainKHR(device.handle, &info, nullptr, &handle), "create the images of a window");
    return handle;
}

VkSemaphore createSemaphore(Device& device) {
    const VkSemaphoreCreateInfo info{VK_STRUCTURE_TYPE_SEMAPHORE_CREATE_INFO};
    VkSemaphore semaphore = VK_NULL_HANDLE;
    check(vkCreateSemaphore(device.handle, &info, nullptr, &semaphore), "create a semaphore");
    return semaphore;
}

void listImages(Device& device, Swapchain& swapchain) {
    std::uint32_t count = 0;
    check(vkGetSwapchainImagesKHR(device.handle, swapchain.handle, &count, nullptr), "list the images of a window");
    swapchain.images.resize(count);
    check(vkGetSwapchainImagesKHR(device.handle, swapchain.handle, &count, swapchain.images.data()),
          "list the images of a window");
    for (VkImage image : swapchain.images) {
        swapchain.views.push_back(createView(device, image, swapchain.format));
        swapchain.drawn.push_back(createSemaphore(device));
    }
    for (VkSemaphore& acquired : swapchain.acquired) acquired = createSemaphore(device);
}

void destroyImages(Device& device, Swapchain& swapchain) {
    for (VkImageView view : swapchain.views) vkDestroyImageView(device.handle, view, nullptr);
    for (VkSemaphore semaphore : swapchain.drawn) vkDestroySemaphore(device.handle, semaphore, nullptr);
    for (VkSemaphore acquired : swapchain.acquired) vkDestroySemaphore(device.handle, acquired, nullptr);
    swapchain.images.clear();
    swapchain.views.clear();
    swapchain.drawn.clear();
    swapchain.acquired = {};
}

} // namespace

Swapchain createSwapchain(Device& device, VkSurfaceKHR surface) {
    Swapchain swapchain;
    swapchain.surface = surface;
    swapchain.format = chooseFormat(device, surface);
    swapchain.present_mode = choosePresentMode(device, surface);
    return swapchain;
}

void destroySwapchain(Device& device, Swapchain& swapchain) {
    destroyImages(device, swapchain);
    if (swapchain.handle) vkDestroySwapchainKHR(device.handle, swapchain.handle, nullptr);
    swapchain = {};
}

void rebuildSwapchain(Device& device, Swapchain& swapchain, VkExtent2D wanted) {
    {
        // no fence signals when a presentation has finished with a semaphore, but an idle queue implies it
        const auto lock = lockQueue(device);
        check(vkQueueWaitIdle(device.queue), "wait for the device");
    }
    destroyImages(device, swapchain);
    const VkSurfaceCapabilitiesKHR capabilities = capabilitiesOf(device, swapchain.surface);
    swapchain.extent = extentFor(capabilities, wanted);
    const VkSwapchainKHR old = std::exchange(swapchain.handle, VK_NULL_HANDLE);
    try {
        if (swapchain.extent.width != 0 && swapchain.extent.height != 0)
            swapchain.handle = createHandle(device, swapchain, capabilities, old);
    } catch (...) {
        if (old) vkDestroySwapchainKHR(device.handle, old, nullptr);
        throw;
    }
    if (old) vkDestroySwapchainKHR(device.handle, old, nullptr);
    if (swapchain.handle) listImages(device, swapchain);
}

std::optional<std::uint32_t> acquireImage(Device& device, const Swapchain& swapchain, VkSemaphore acquired,
                                          bool& outdated) {
    std::uint32_t image = 0;
    const VkResult result =
        vkAcquireNextImageKHR(device.handle, swapchain.handle, kAcquireNanoseconds, acquired, VK_NULL_HANDLE, &image);
    if (result == VK_SUCCESS || result == VK_SUBOPTIMAL_KHR) return image;
    outdated = result == VK_ERROR_OUT_OF_DATE_KHR;
    if (!outdated && result != VK_TIMEOUT && result != VK_NOT_READY)
        checkWindow(result, "acquire an image of the window");
    return {};
}

bool presentImage(Device& device, const Swapchain& swapchain, std::uint32_t image) {
    VkPresentInfoKHR info{VK_STRUCTURE_TYPE_PRESENT_INFO_KHR};
    info.waitSemaphoreCount = 1;
    info.pWaitSemaphores = &swapchain.drawn[image];
    info.swapchainCount = 1;
    info.pSwapchains = &swapchain.handle;
    info.pImageIndices = &image;
    const auto lock = lockQueue(device);
    const VkResult result = vkQueuePresentKHR(device.queue, &info);
    if (result == VK_SUBOPTIMAL_KHR || result == VK_ERROR_OUT_OF_DATE_KHR) return false;
    checkWindow(result, "present a picture in the window");
    return true;
}

} // namespace pointrt

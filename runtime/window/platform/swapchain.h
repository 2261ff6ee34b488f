// SPDX-License-Identifier: Apache-2.0
// The images of a window, and their way to the screen.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "runtime/gpu/device.h"

namespace pointrt {

/// The images that a surface shows in turn. handle is null while the window has no pixels (minimised).
struct Swapchain {
    VkSurfaceKHR surface = VK_NULL_HANDLE; ///< the caller's
    VkSwapchainKHR handle = VK_NULL_HANDLE;
    VkFormat format =
        VK_FORMAT_UNDEFINED; ///< 8-bit UNORM, BGRA where there is a choice: pixels are sRGB-encoded already
    VkExtent2D extent{};
    VkPresentModeKHR present_mode = VK_PRESENT_MODE_FIFO_KHR;
    std::vector<VkImage> images;
    std::vector<VkImageView> views;
    std::vector<VkSemaphore> drawn; ///< one an image: it may be presented
    VkSemaphore acquired = VK_NULL_HANDLE;
};

/// Picks format and present mode; rebuildSwapchain makes the images. Throws Error kCannotRun when the surface takes no
/// 8-bit colours.
Swapchain createSwapchain(Device& device, VkSurfaceKHR surface);
/// Leaves the surface to its owner. Nothing of it may be in use.
void destroySwapchain(Device& device, Swapchain& swapchain);

/// Images for the surface as it is now, of the size wanted where the surface leaves that open (Wayland); waits until
/// the old ones are out of use. Throws Error kCannotRun (surface or device lost).
void rebuildSwapchain(Device& device, Swapchain& swapchain, VkExtent2D wanted);

/// The next image to draw on, once swapchain.acquired is signalled. None when the swapchain must be rebuilt (then
/// outdated becomes true) or all images are on their way (hidden windows). Throws Error kCannotRun (surface or device
/// lost).
std::optional<std::uint32_t> acquireImage(Device& device, const Swapchain& swapchain, bool& outdated);

/// Shows image once drawn[image] is signalled. False when the swapchain should be rebuilt. Throws as acquireImage.
bool presentImage(Device& device, const Swapchain& swapchain, std::uint32_t image);

} // namespace pointrt

// SPDX-License-Identifier: Apache-2.0
// The window's swapchain.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <vector>

#include "runtime/gpu/device.h"

namespace pointrt {

/// handle is null while the window is minimised and so has no pixels.
struct Swapchain {
    VkSurfaceKHR surface = VK_NULL_HANDLE; ///< not owned
    VkSwapchainKHR handle = VK_NULL_HANDLE;
    VkFormat format = VK_FORMAT_UNDEFINED; ///< 8-bit UNORM, BGRA if available: pixels are already sRGB-encoded
    VkExtent2D extent{};
    VkPresentModeKHR present_mode = VK_PRESENT_MODE_FIFO_KHR;
    std::vector<VkImage> images;
    std::vector<VkImageView> views;
    std::vector<VkSemaphore> drawn;                      ///< one per image, signalled when the image may be presented
    std::array<VkSemaphore, kFramesInFlight> acquired{}; ///< one per frame
};

/// Chooses format and present mode; rebuildSwapchain creates the images. Throws Error kCannotRun if the surface has no
/// 8-bit format.
Swapchain createSwapchain(Device& device, VkSurfaceKHR surface);
/// Does not destroy the surface. The swapchain must be idle.
void destroySwapchain(Device& device, Swapchain& swapchain);

/// Creates images for the surface's current size, or of the wanted size if the surface allows any (Wayland). Waits
/// until the old images are idle. Throws Error kCannotRun (surface or device lost).
void rebuildSwapchain(Device& device, Swapchain& swapchain, VkExtent2D wanted);

/// Acquires the next image, ready when the semaphore is signalled. None if the swapchain must be rebuilt (sets
/// outdated), or if no image is free (hidden windows). Throws Error kCannotRun (surface or device lost).
std::optional<std::uint32_t> acquireImage(Device& device, const Swapchain& swapchain, VkSemaphore acquired,
                                          bool& outdated);

/// Presents image once drawn[image] is signalled. Returns false if the swapchain should be rebuilt. Throws as
/// acquireImage does.
bool presentImage(Device& device, const Swapchain& swapchain, std::uint32_t image);

} // namespace pointrt

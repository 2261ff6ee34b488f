// SPDX-License-Identifier: Apache-2.0
// The picture's way to the screen: canvas -> window image -> UI on top -> display. Without a window it ends at an
// image that can be read back.
#pragma once

#include <cstdint>
#include <vector>

#include "runtime/gpu/resources.h"
#include "runtime/image/image_png.h"
#include "runtime/window/platform/image.h"
#include "runtime/window/platform/swapchain.h"
#include "runtime/window/platform/ui_renderer.h"

struct ImDrawData;

namespace pointrt {

/// What shows pictures. One thread uses it. Pixels are packed BGRA8 everywhere, a 32-bit word 0xAARRGGBB each, rows
/// from the top, sRGB-encoded: what windows take without conversion.
struct Presenter {
    VkSurfaceKHR surface = VK_NULL_HANDLE; ///< owned; null when headless
    Swapchain swapchain;
    bool outdated = true;                       ///< the swapchain must be rebuilt before the next frame
    std::vector<VkFramebuffer> framebuffers;    ///< one a swapchain image
    Image canvas;                               ///< keeps the last picture; in use as kTransferSrc
    Image low_res;                              ///< a smaller picture on its way to the canvas
    Buffer host_upscaled;                       ///< the same on the host, where that is the device
    Image frame;                                ///< picture and UI where no window takes them
    VkFramebuffer framebuffer = VK_NULL_HANDLE; ///< of frame
    UiRenderer ui;
    VkCommandBuffer commands = VK_NULL_HANDLE;
    VkFence done = VK_NULL_HANDLE; ///< of the frame on its way
    bool in_flight = false;
};

/// For a window's surface (which it owns from now on, even when this throws) or, without one, headless; the canvas is
/// black and of width x height pixels, both at least 1. device was asked for graphics, with the window's extensions
/// where there is a surface. Throws Error kCannotRun.
Presenter createPresenter(Device& device, VkSurfaceKHR surface, std::uint32_t width, std::uint32_t height);
void destroyPresenter(Device& device, Presenter& presenter);

/// A canvas for a window that is now width x height pixels; it shows the last picture stretched. 0 x 0 (minimised)
/// keeps everything as it is. Command buffers recorded with the old canvas must be done. Throws Error kCannotRun.
void resizeCanvas(Device& device, Presenter& presenter, std::uint32_t width, std::uint32_t height);

/// Copies rows of pixels, a buffer as large as the canvas, to the same rows of the canvas. Compute shaders and
/// transfers recorded before may write pixels.
void recordUploadRows(VkCommandBuffer commands, const Presenter& presenter, const Buffer& pixels,
                      std::uint32_t first_row, std::uint32_t rows);

/// Stretches pixels, width x height of them and neither more than the canvas has, over the whole canvas, with bilinear
/// interpolation between pixel centres. Compute shaders and transfers recorded before may write pixels.
void recordUploadScaled(VkCommandBuffer commands, const Presenter& presenter, const Buffer& pixels, std::uint32_t width,
                        std::uint32_t height);

/// The same at once: returns when the canvas has the picture. Everything that writes pixels must be done. CPU devices
/// enlarge on the host, in a third of the time.
void uploadScaled(Device& device, Presenter& presenter, const Buffer& pixels, std::uint32_t width,
                  std::uint32_t height);

/// Shows the canvas with ui (or without, where null) on top, and returns while the device is at it; waits for the frame
/// before. A window that changed its size under way shows the canvas stretched. False when nothing could be shown:
/// minimised, or hidden. Throws Error kCannotRun (surface or device lost).
bool present(Device& device, Presenter& presenter, const ImDrawData* ui);

/// Uploads ImGui's fonts (uploadUiFont) between frames.
void setUiFont(Device& device, Presenter& presenter);

/// The canvas as RGB.
Image8 readCanvas(Device& device, Presenter& presenter);
/// The canvas with ui on top, as RGB: what present shows.
Image8 readFrame(Device& device, Presenter& presenter, const ImDrawData* ui);

} // namespace pointrt

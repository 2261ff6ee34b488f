// SPDX-License-Identifier: Apache-2.0
// Presents pictures: canvas -> swapchain image -> UI on top -> display. Without a window the last step is an image that
// can be read back.
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <vector>

#include "runtime/gpu/resources.h"
#include "runtime/image/image_png.h"
#include "runtime/window/platform/image.h"
#include "runtime/window/platform/swapchain.h"
#include "runtime/window/platform/ui_renderer.h"

struct ImDrawData;

namespace pointrt {

/// For use by one thread. Pixels are packed BGRA8, 0xAARRGGBB each, rows from the top, sRGB-encoded, so that windows
/// display them without conversion.
struct Presenter {
    VkSurfaceKHR surface = VK_NULL_HANDLE; ///< owned; null when headless
    Swapchain swapchain;
    bool outdated = true;                       ///< rebuild the swapchain before the next frame
    std::vector<VkFramebuffer> framebuffers;    ///< one per swapchain image
    Image canvas;                               ///< holds the last picture; in kTransferSrc
    Image low_res;                              ///< a preview, to be scaled to the canvas
    Buffer host_upscaled;                       ///< the scaled preview, when scaled on the host
    Image target;                               ///< picture and UI when there is no window
    VkFramebuffer framebuffer = VK_NULL_HANDLE; ///< of target
    UiRenderer ui;
    std::array<std::uint64_t, kFramesInFlight> frames{}; ///< submissions of the last frames
    std::uint32_t frame = 0;                             ///< index of the next frame
};

/// For a window's surface, or headless if surface is null. Takes ownership of the surface, even if this throws. The
/// canvas is black, width x height pixels, at least 1 x 1. device was requested with graphics and, for a surface, the
/// window's extensions. Throws Error kCannotRun.
Presenter createPresenter(Device& device, VkSurfaceKHR surface, std::uint32_t width, std::uint32_t height);
void destroyPresenter(Device& device, Presenter& presenter);

/// Resizes the canvas to width x height pixels, with the last picture scaled to it. 0 x 0 (minimised) does nothing.
/// Command buffers that use the old canvas must have finished. Throws Error kCannotRun.
void resizeCanvas(Device& device, Presenter& presenter, std::uint32_t width, std::uint32_t height);

/// Copies rows of pixels, a buffer of the canvas's size, to the same rows of the canvas. Waits for compute shaders and
/// transfers recorded before.
void recordUploadRows(VkCommandBuffer commands, const Presenter& presenter, const Buffer& pixels,
                      std::uint32_t first_row, std::uint32_t rows);

/// Scales pixels (width x height, at most the canvas's size) to the whole canvas with bilinear interpolation between
/// pixel centres. Waits for compute shaders and transfers recorded before.
void recordUploadScaled(VkCommandBuffer commands, const Presenter& presenter, const Buffer& pixels, std::uint32_t width,
                        std::uint32_t height);

/// The same, but with a CPU device the host scales at once, in a third of the time; writes to pixels must then have
/// finished.
void recordUploadPreview(Device& device, VkCommandBuffer commands, Presenter& presenter, const Buffer& pixels,
                         std::uint32_t width, std::uint32_t height);

/// Presents the canvas with ui on top (null: none) and returns without waiting for the device, except for the frame
/// kFramesInFlight earlier. If the window's size has just changed, scales the canvas. Returns false if nothing can be
/// shown because the window is minimised or hidden. Throws Error kCannotRun (surface or device lost).
/// @param uploads records commands that update the canvas, in the same submission; they run even if nothing is shown
bool present(Device& device, Presenter& presenter, const ImDrawData* ui,
             const std::function<void(VkCommandBuffer)>& uploads = {});

/// Uploads ImGui's font atlas between frames (uploadUiFont).
void setUiFont(Device& device, Presenter& presenter);

/// The canvas as RGB.
Image8 readCanvas(Device& device, Presenter& presenter);
/// The canvas with ui on top, as present shows it, as RGB.
Image8 readFrame(Device& device, Presenter& presenter, const ImDrawData* ui);

} // namespace pointrt

// SPDX-License-Identifier: Apache-2.0
// Vulkan copies between buffers, the canvas and the frame on the screen.
#pragma once

#include "runtime/image/image_png.h"
#include "runtime/window/platform/image.h"

namespace pointrt {

constexpr VkFormat kCanvasFormat = VK_FORMAT_B8G8R8A8_UNORM;

/// An image to render a frame to.
struct FrameTarget {
    VkImage image = VK_NULL_HANDLE;
    VkFormat format = VK_FORMAT_UNDEFINED;
    VkFramebuffer framebuffer = VK_NULL_HANDLE;
    VkExtent2D extent{};
    ImageUse end{}; ///< use after the frame
};

/// The offscreen frame, which can be read back.
FrameTarget frameTarget(const Image& frame, VkFramebuffer framebuffer);

/// Clears an image in kTransferDst to opaque black.
void recordBlack(VkCommandBuffer commands, const Image& image);

/// Scales the upper left part of an image in kTransferSrc to all of another one in kTransferDst, with bilinear
/// interpolation between pixel centres.
void recordBlit(VkCommandBuffer commands, const Image& from, VkExtent2D part, VkImage to, VkExtent2D to_extent);

/// Copies the canvas (in kTransferSrc) to all of target, whose old contents are discarded. Leaves target in
/// kTransferDst.
void recordCanvas(VkCommandBuffer commands, const Image& canvas, const FrameTarget& target);

/// A copy of a rectangle between a buffer (at pixel from, with pitch pixels per row) and an image (at to).
VkBufferImageCopy rectangleCopy(VkOffset2D from, std::uint32_t pitch, VkOffset2D to, VkExtent2D size);

/// Records a copy of image (8-bit BGRA or RGBA, in kTransferSrc), submits commands, waits, and returns the image as
/// RGB.
Image8 readImage(Device& device, VkCommandBuffer commands, const Image& image);

} // namespace pointrt

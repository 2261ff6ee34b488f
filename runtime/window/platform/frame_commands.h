// SPDX-License-Identifier: Apache-2.0
// The copies between buffers, the canvas and what is shown.
#pragma once

#include "runtime/image/image_png.h"
#include "runtime/window/platform/image.h"

namespace pointrt {

constexpr VkFormat kCanvasFormat = VK_FORMAT_B8G8R8A8_UNORM;

/// An image that gets a frame.
struct FrameTarget {
    VkImage image = VK_NULL_HANDLE;
    VkFormat format = VK_FORMAT_UNDEFINED;
    VkFramebuffer framebuffer = VK_NULL_HANDLE;
    VkExtent2D extent{};
    ImageUse end{}; ///< what happens to it afterwards
};

/// The frame of no window, to be read back.
FrameTarget frameTarget(const Image& frame, VkFramebuffer framebuffer);

/// Fills an image in use as kTransferDst with opaque black.
void recordBlack(VkCommandBuffer commands, const Image& image);

/// Stretches the upper left part of an image in use as kTransferSrc over all of another in use as kTransferDst, with
/// bilinear interpolation between pixel centres.
void recordBlit(VkCommandBuffer commands, const Image& from, VkExtent2D part, VkImage to, VkExtent2D to_extent);

/// The canvas, in use as kTransferSrc, on all of target, whatever that held; in use as kTransferDst afterwards.
void recordCanvas(VkCommandBuffer commands, const Image& canvas, const FrameTarget& target);

/// The copy of a size of pixels between the one at from of a buffer, with pitch of them in a row, and the one at to of
/// an image.
VkBufferImageCopy rectangleCopy(VkOffset2D from, std::uint32_t pitch, VkOffset2D to, VkExtent2D size);

/// Adds a copy of image (8-bit BGRA or RGBA, in use as kTransferSrc) to commands, submits them, waits and returns it as
/// RGB.
Image8 readImage(Device& device, VkCommandBuffer commands, const Image& image);

} // namespace pointrt

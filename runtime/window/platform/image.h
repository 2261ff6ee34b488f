// SPDX-License-Identifier: Apache-2.0
// Device images for the window: the picture, the UI's font, a frame that is no window's.
#pragma once

#include <cstdint>

#include "runtime/gpu/device.h"

namespace pointrt {

/// A 2D image with its own device memory and a view of all of it. Plain data: free it with destroyImage, once.
struct Image {
    VkImage handle = VK_NULL_HANDLE;
    VkDeviceMemory memory = VK_NULL_HANDLE;
    VkImageView view = VK_NULL_HANDLE;
    VkFormat format = VK_FORMAT_UNDEFINED;
    VkExtent2D extent{};
};

/// what names the image in messages. usage gets the transfer bits besides the given ones; the view passes channels on
/// as swizzle says. Throws Error kCannotRun: out of memory, or larger than the device's largest image.
Image createImage(Device& device, const char* what, VkFormat format, VkExtent2D extent, VkImageUsageFlags usage,
                  VkComponentMapping swizzle = {});
void destroyImage(Device& device, Image& image);

/// A view of all of a colour image.
VkImageView createView(Device& device, VkImage image, VkFormat format, VkComponentMapping swizzle = {});

/// Where an image is used: by which stages, for what, and in which layout.
struct ImageUse {
    VkPipelineStageFlags stages;
    VkAccessFlags access;
    VkImageLayout layout;
};

constexpr ImageUse kTransferDst{VK_PIPELINE_STAGE_TRANSFER_BIT, VK_ACCESS_TRANSFER_WRITE_BIT,
                                VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL};
constexpr ImageUse kTransferSrc{VK_PIPELINE_STAGE_TRANSFER_BIT, VK_ACCESS_TRANSFER_READ_BIT,
                                VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL};
constexpr ImageUse kColorAttachment{VK_PIPELINE_STAGE_COLOR_ATTACHMENT_OUTPUT_BIT,
                                    VK_ACCESS_COLOR_ATTACHMENT_READ_BIT | VK_ACCESS_COLOR_ATTACHMENT_WRITE_BIT,
                                    VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL};
constexpr ImageUse kSampled{VK_PIPELINE_STAGE_FRAGMENT_SHADER_BIT, VK_ACCESS_SHADER_READ_BIT,
                            VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL};
constexpr ImageUse kPresentSrc{VK_PIPELINE_STAGE_BOTTOM_OF_PIPE_BIT, 0, VK_IMAGE_LAYOUT_PRESENT_SRC_KHR};

/// from, with what the image held given up.
constexpr ImageUse discarded(ImageUse from) { return {from.stages, from.access, VK_IMAGE_LAYOUT_UNDEFINED}; }

/// Uses recorded before see the image as from, later ones as to.
void recordImageBarrier(VkCommandBuffer commands, VkImage image, ImageUse from, ImageUse to);

constexpr VkImageSubresourceLayers kColorLayer{VK_IMAGE_ASPECT_COLOR_BIT, 0, 0, 1};

} // namespace pointrt

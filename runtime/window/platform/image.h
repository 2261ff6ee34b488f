// SPDX-License-Identifier: Apache-2.0
// Device images for the window: the canvas, the UI's font, the offscreen frame.
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

/// what: for messages. usage: besides transfers, which are always allowed. swizzle: of the view. Throws Error
/// kCannotRun if memory runs out or extent exceeds the device's limit.
Image createImage(Device& device, const char* what, VkFormat format, VkExtent2D extent, VkImageUsageFlags usage,
                  VkComponentMapping swizzle = {});
void destroyImage(Device& device, Image& image);

/// A view of a whole colour image.
VkImageView createView(Device& device, VkImage image, VkFormat format, VkComponentMapping swizzle = {});

/// A use of an image: pipeline stages, access and layout.
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

/// The same use, with the old contents discarded.
constexpr ImageUse discarded(ImageUse from) { return {from.stages, from.access, VK_IMAGE_LAYOUT_UNDEFINED}; }

/// Transitions image from one use to another.
void recordImageBarrier(VkCommandBuffer commands, VkImage image, ImageUse from, ImageUse to);

constexpr VkImageSubresourceLayers kColorLayer{VK_IMAGE_ASPECT_COLOR_BIT, 0, 0, 1};

} // namespace pointrt

// SPDX-License-Identifier: Apache-2.0
// Dear ImGui's triangles on top of an image, with one pipeline.
#pragma once

#include "runtime/gpu/device.h"
#include "runtime/gpu/resources.h"
#include "runtime/window/platform/image.h"

struct ImDrawData;

namespace pointrt {

/// What drawing the UI takes. One frame is drawn at a time: recordUi writes the buffers that the last one read.
struct UiRenderer {
    VkRenderPass pass = VK_NULL_HANDLE;
    VkSampler sampler = VK_NULL_HANDLE;
    VkDescriptorSetLayout set_layout = VK_NULL_HANDLE;
    VkDescriptorPool pool = VK_NULL_HANDLE;
    VkDescriptorSet set = VK_NULL_HANDLE;
    VkPipelineLayout layout = VK_NULL_HANDLE;
    VkPipeline pipeline = VK_NULL_HANDLE;
    Image font;
    Buffer vertices, indices;
};

/// A renderer for images of format. device was asked for graphics. Throws Error kCannotRun where the driver refuses.
UiRenderer createUiRenderer(Device& device, VkFormat format);
void destroyUiRenderer(Device& device, UiRenderer& ui);

/// Uploads the font atlas of the current ImGui context and tells ImGui what this renderer can do. Again after every
/// change of the atlas; not while a frame is being drawn.
void uploadUiFont(Device& device, UiRenderer& ui);

/// The framebuffer of an image, for recordUi. The caller destroys it.
VkFramebuffer createUiFramebuffer(Device& device, const UiRenderer& ui, VkImageView view, VkExtent2D extent);

/// Records data over what framebuffer, of extent pixels, holds: in use as kColorAttachment, before and after. Only
/// after uploadUiFont; the frame recorded before must be done.
void recordUi(Device& device, UiRenderer& ui, VkCommandBuffer commands, VkFramebuffer framebuffer, VkExtent2D extent,
              const ImDrawData& data);

} // namespace pointrt

// SPDX-License-Identifier: Apache-2.0
// Draws Dear ImGui's triangles over an image.
#pragma once

#include <array>

#include "runtime/gpu/device.h"
#include "runtime/gpu/resources.h"
#include "runtime/window/platform/image.h"

struct ImDrawData;

namespace pointrt {

/// Triangles of a frame.
struct UiBuffers {
    Buffer vertices, indices;
};

/// Vulkan objects that draw the UI. recordUi overwrites the buffers of the frame kFramesInFlight earlier.
struct UiRenderer {
    VkRenderPass pass = VK_NULL_HANDLE;
    VkSampler sampler = VK_NULL_HANDLE;
    VkDescriptorSetLayout set_layout = VK_NULL_HANDLE;
    VkDescriptorPool pool = VK_NULL_HANDLE;
    VkDescriptorSet set = VK_NULL_HANDLE;
    VkPipelineLayout layout = VK_NULL_HANDLE;
    VkPipeline pipeline = VK_NULL_HANDLE;
    Image font;
    std::array<UiBuffers, kFramesInFlight> buffers;
    std::uint32_t frame = 0; ///< index of the last frame's buffers
};

/// For images of this format. device was requested with graphics. Throws Error kCannotRun if the driver fails.
UiRenderer createUiRenderer(Device& device, VkFormat format);
void destroyUiRenderer(Device& device, UiRenderer& ui);

/// Uploads the font atlas of the current ImGui context and sets ImGui's backend flags. Repeat after each change of the
/// atlas, while no frame is in flight.
void uploadUiFont(Device& device, UiRenderer& ui);

/// A framebuffer for recordUi, owned by the caller.
VkFramebuffer createUiFramebuffer(Device& device, const UiRenderer& ui, VkImageView view, VkExtent2D extent);

/// Records drawing data over the contents of framebuffer, which is in kColorAttachment before and after. Requires
/// uploadUiFont. All but the last kFramesInFlight - 1 frames must have finished.
void recordUi(Device& device, UiRenderer& ui, VkCommandBuffer commands, VkFramebuffer framebuffer, VkExtent2D extent,
              const ImDrawData& data);

} // namespace pointrt

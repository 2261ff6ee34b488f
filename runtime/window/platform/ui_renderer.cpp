// SPDX-License-Identifier: Apache-2.0
#include "runtime/window/platform/ui_renderer.h"

#include <imgui.h>

#include <algorithm>
#include <cstring>
#include <stdexcept>

#include "runtime/gpu/program.h"
#include "runtime/window/platform/ui_pipeline.h"

namespace pointrt {
namespace {

/// Grows buffer to at least bytes, half as much again so that a growing panel does not reallocate every frame.
void reserve(Device& device, Buffer& buffer, const char* what, std::uint64_t bytes, VkBufferUsageFlags usage) {
    if (buffer.bytes >= bytes) return;
    destroyBuffer(device, buffer);
    buffer = createBuffer(device, what, bytes + bytes / 2, usage, MemoryHome::kUpload);
}

void fillBuffers(Device& device, UiBuffers& buffers, const ImDrawData& data) {
    const auto vertices = static_cast<std::uint64_t>(data.TotalVtxCount) * sizeof(ImDrawVert);
    const auto indices = static_cast<std::uint64_t>(data.TotalIdxCount) * sizeof(ImDrawIdx);
    reserve(device, buffers.vertices, "UI vertices", vertices, VK_BUFFER_USAGE_VERTEX_BUFFER_BIT);
    reserve(device, buffers.indices, "UI indices", indices, VK_BUFFER_USAGE_INDEX_BUFFER_BIT);
    auto* vertex = static_cast<ImDrawVert*>(buffers.vertices.mapped);
    auto* index = static_cast<ImDrawIdx*>(buffers.indices.mapped);
    for (int i = 0; i < data.CmdListsCount; ++i) {
        const ImDrawList& list = *data.CmdLists[i];
        std::memcpy(vertex, list.VtxBuffer.Data, static_cast<std::size_t>(list.VtxBuffer.size_in_bytes()));
        std::memcpy(index, list.IdxBuffer.Data, static_cast<std::size_t>(list.IdxBuffer.size_in_bytes()));
        vertex += list.VtxBuffer.Size;
        index += list.IdxBuffer.Size;
    }
}

void recordState(const UiRenderer& ui, VkCommandBuffer commands, VkExtent2D extent, const ImDrawData& data) {
    vkCmdBindPipeline(commands, VK_PIPELINE_BIND_POINT_GRAPHICS, ui.pipeline);
    vkCmdBindDescriptorSets(commands, VK_PIPELINE_BIND_POINT_GRAPHICS, ui.layout, 0, 1, &ui.set, 0, nullptr);
    const VkDeviceSize start = 0;
    vkCmdBindVertexBuffers(commands, 0, 1, &ui.buffers[ui.frame].vertices.handle, &start);
    static_assert(sizeof(ImDrawIdx) == 2);
    vkCmdBindIndexBuffer(commands, ui.buffers[ui.frame].indices.handle, 0, VK_INDEX_TYPE_UINT16);
    const VkViewport viewport{0, 0, static_cast<float>(extent.width), static_cast<float>(extent.height), 0, 1};
    vkCmdSetViewport(commands, 0, 1, &viewport);
    UiPush push;
    push.scale[0] = 2 / data.DisplaySize.x;
    push.scale[1] = 2 / data.DisplaySize.y;
    push.offset[0] = -1 - data.DisplayPos.x * push.scale[0];
    push.offset[1] = -1 - data.DisplayPos.y * push.scale[1];
    vkCmdPushConstants(commands, ui.layout, VK_SHADER_STAGE_VERTEX_BIT, 0, sizeof push, &push);
}

/// A draw command's clip rectangle in pixels; empty if it is outside the image.
VkRect2D scissorOf(const ImDrawCmd& command, const ImDrawData& data, VkExtent2D extent) {
    const auto clip = [](float position, float origin, float scale, std::uint32_t end) {
        return static_cast<std::int32_t>(std::clamp((position - origin) * scale, 0.0f, static_cast<float>(end)));
    };
    const ImVec2 origin = data.DisplayPos, scale = data.FramebufferScale;
    const std::int32_t left = clip(command.ClipRect.x, origin.x, scale.x, extent.width);
    const std::int32_t top = clip(command.ClipRect.y, origin.y, scale.y, extent.height);
    const std::int32_t right = clip(command.ClipRect.z, origin.x, scale.x, extent.width);
    const std::int32_t bottom = clip(command.ClipRect.w, origin.y, scale.y, extent.height);
    return {
        {left, top},
        {static_cast<std::uint32_t>(std::max(right - left, 0)), static_cast<std::uint32_t>(std::max(bottom - top, 0))}};
}

void recordTriangles(VkCommandBuffer commands, VkExtent2D extent, const ImDrawData& data) {
    std::uint32_t first_index = 0;
    std::int32_t first_vertex = 0;
    for (int i = 0; i < data.CmdListsCount; ++i) {
        const ImDrawList& list = *data.CmdLists[i];
        for (const ImDrawCmd& command : list.CmdBuffer) {
            const VkRect2D scissor = scissorOf(command, data, extent);
            if (scissor.extent.width == 0 || scissor.extent.height == 0) continue;
            vkCmdSetScissor(commands, 0, 1, &scissor);
            vkCmdDrawIndexed(commands, command.ElemCount, 1, first_index + command.IdxOffset,
                             first_vertex + static_cast<std::int32_t>(command.VtxOffset), 0);
        }
        first_index += static_cast<std::uint32_t>(list.IdxBuffer.Size);
        first_vertex += list.VtxBuffer.Size;
    }
}

/// Uploads coverage, one byte per texel, to the new font image.
void uploadCoverage(Device& device, UiRenderer& ui, const void* coverage) {
    const VkExtent2D extent = ui.font.extent;
    const std::uint64_t bytes = std::uint64_t(extent.width) * extent.height;
    Buffer staging = createBuffer(device, "font buffer", bytes, 0, MemoryHome::kUpload);
    std::memcpy(staging.mapped, coverage, bytes);
    const VkCommandBuffer commands = beginCommands(device);
    recordImageBarrier(commands, ui.font.handle, discarded(kTransferDst), kTransferDst);
    VkBufferImageCopy region{};
    region.imageSubresource = kColorLayer;
    region.imageExtent = {extent.width, extent.height, 1};
    vkCmdCopyBufferToImage(commands, staging.handle, ui.font.handle, kTransferDst.layout, 1, &region);
    recordImageBarrier(commands, ui.font.handle, kTransferDst, kSampled);
    submitAndWait(device, commands);
    destroyBuffer(device, staging);
}

void bindFont(Device& device, UiRenderer& ui) {
    VkDescriptorImageInfo info{};
    info.imageView = ui.font.view;
    info.imageLayout = kSampled.layout;
    VkWriteDescriptorSet write{VK_STRUCTURE_TYPE_WRITE_DESCRIPTOR_SET};
    write.dstSet = ui.set;
    write.descriptorCount = 1;
    write.descriptorType = VK_DESCRIPTOR_TYPE_COMBINED_IMAGE_SAMPLER;
    write.pImageInfo = &info;
    vkUpdateDescriptorSets(device.handle, 1, &write, 0, nullptr);
}

} // namespace

void uploadUiFont(Device& device, UiRenderer& ui) {
    ImGuiIO& io = ImGui::GetIO();
    unsigned char* coverage = nullptr;
    int width = 0, height = 0;
    io.Fonts->GetTexDataAsAlpha8(&coverage, &width, &height);
    destroyImage(device, ui.font);
    const VkExtent2D extent{static_cast<std::uint32_t>(width), static_cast<std::uint32_t>(height)};
    // white, with coverage as alpha
    const VkComponentMapping white{VK_COMPONENT_SWIZZLE_ONE, VK_COMPONENT_SWIZZLE_ONE, VK_COMPONENT_SWIZZLE_ONE,
                                   VK_COMPONENT_SWIZZLE_R};
    ui.font = createImage(device, "font image", VK_FORMAT_R8_UNORM, extent, VK_IMAGE_USAGE_SAMPLED_BIT, white);
    uploadCoverage(device, ui, coverage);
    bindFont(device, ui);
    io.BackendFlags |= ImGuiBackendFlags_RendererHasVtxOffset;
    io.BackendRendererName = "pointrt";
}

VkFramebuffer createUiFramebuffer(Device& device, const UiRenderer& ui, VkImageView view, VkExtent2D extent) {
    VkFramebufferCreateInfo info{VK_STRUCTURE_TYPE_FRAMEBUFFER_CREATE_INFO};
    info.renderPass = ui.pass;
    info.attachmentCount = 1;
    info.pAttachments = &view;
    info.width = extent.width;
    info.height = extent.height;
    info.layers = 1;
    VkFramebuffer framebuffer = VK_NULL_HANDLE;
    check(vkCreateFramebuffer(device.handle, &info, nullptr, &framebuffer), "create a framebuffer");
    return framebuffer;
}

void recordUi(Device& device, UiRenderer& ui, VkCommandBuffer commands, VkFramebuffer framebuffer, VkExtent2D extent,
              const ImDrawData& data) {
    if (!ui.font.handle) throw std::logic_error("recordUi before uploadUiFont");
    if (data.TotalIdxCount == 0) return;
    ui.frame = (ui.frame + 1) % kFramesInFlight;
    fillBuffers(device, ui.buffers[ui.frame], data);
    VkRenderPassBeginInfo begin{VK_STRUCTURE_TYPE_RENDER_PASS_BEGIN_INFO};
    begin.renderPass = ui.pass;
    begin.framebuffer = framebuffer;
    begin.renderArea.extent = extent;
    vkCmdBeginRenderPass(commands, &begin, VK_SUBPASS_CONTENTS_INLINE);
    recordState(ui, commands, extent, data);
    recordTriangles(commands, extent, data);
    vkCmdEndRenderPass(commands);
}

} // namespace pointrt

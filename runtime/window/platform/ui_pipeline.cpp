// SPDX-License-Identifier: Apache-2.0
#include "runtime/window/platform/ui_pipeline.h"

#include <imgui.h>

#include <cstddef>
#include <span>

#include "runtime/util/on_error.h"
#include "runtime/window/platform/ui_renderer.h"
#include "shaders/ui_frag.spv.h"
#include "shaders/ui_vert.spv.h"

namespace pointrt {
namespace {

/// Loads and keeps the attachment's contents. The caller handles layouts and synchronisation.
VkRenderPass createPass(Device& device, VkFormat format) {
    VkAttachmentDescription color{};
    color.format = format;
    color.samples = VK_SAMPLE_COUNT_1_BIT;
    color.loadOp = VK_ATTACHMENT_LOAD_OP_LOAD;
    color.storeOp = VK_ATTACHMENT_STORE_OP_STORE;
    color.stencilLoadOp = VK_ATTACHMENT_LOAD_OP_DONT_CARE;
    color.stencilStoreOp = VK_ATTACHMENT_STORE_OP_DONT_CARE;
    color.initialLayout = color.finalLayout = kColorAttachment.layout;
    const VkAttachmentReference reference{0, kColorAttachment.layout};
    VkSubpassDescription subpass{};
    subpass.pipelineBindPoint = VK_PIPELINE_BIND_POINT_GRAPHICS;
    subpass.colorAttachmentCount = 1;
    subpass.pColorAttachments = &reference;
    VkRenderPassCreateInfo info{VK_STRUCTURE_TYPE_RENDER_PASS_CREATE_INFO};
    info.attachmentCount = 1;
    info.pAttachments = &color;
    info.subpassCount = 1;
    info.pSubpasses = &subpass;
    VkRenderPass pass = VK_NULL_HANDLE;
    check(vkCreateRenderPass(device.handle, &info, nullptr, &pass), "create the UI's render pass");
    return pass;
}

VkSampler createLinearSampler(Device& device) {
    VkSamplerCreateInfo info{VK_STRUCTURE_TYPE_SAMPLER_CREATE_INFO};
    info.magFilter = info.minFilter = VK_FILTER_LINEAR;
    info.addressModeU = info.addressModeV = info.addressModeW = VK_SAMPLER_ADDRESS_MODE_CLAMP_TO_EDGE;
    VkSampler sampler = VK_NULL_HANDLE;
    check(vkCreateSampler(device.handle, &info, nullptr, &sampler), "create the UI's sampler");
    return sampler;
}

void createSet(Device& device, UiRenderer& ui) {
    VkDescriptorSetLayoutBinding binding{};
    binding.descriptorType = VK_DESCRIPTOR_TYPE_COMBINED_IMAGE_SAMPLER;
    binding.descriptorCount = 1;
    binding.stageFlags = VK_SHADER_STAGE_FRAGMENT_BIT;
    binding.pImmutableSamplers = &ui.sampler;
    VkDescriptorSetLayoutCreateInfo layout{VK_STRUCTURE_TYPE_DESCRIPTOR_SET_LAYOUT_CREATE_INFO};
    layout.bindingCount = 1;
    layout.pBindings = &binding;
    check(vkCreateDescriptorSetLayout(device.handle, &layout, nullptr, &ui.set_layout), "create the UI's set layout");

    const VkDescriptorPoolSize size{binding.descriptorType, 1};
    VkDescriptorPoolCreateInfo pool{VK_STRUCTURE_TYPE_DESCRIPTOR_POOL_CREATE_INFO};
    pool.maxSets = 1;
    pool.poolSizeCount = 1;
    pool.pPoolSizes = &size;
    check(vkCreateDescriptorPool(device.handle, &pool, nullptr, &ui.pool), "create the UI's descriptor pool");

    VkDescriptorSetAllocateInfo allocate{VK_STRUCTURE_TYPE_DESCRIPTOR_SET_ALLOCATE_INFO};
    allocate.descriptorPool = ui.pool;
    allocate.descriptorSetCount = 1;
    allocate.pSetLayouts = &ui.set_layout;
    check(vkAllocateDescriptorSets(device.handle, &allocate, &ui.set), "allocate the UI's descriptor set");
}

void createLayout(Device& device, UiRenderer& ui) {
    const VkPushConstantRange push{VK_SHADER_STAGE_VERTEX_BIT, 0, sizeof(UiPush)};
    VkPipelineLayoutCreateInfo info{VK_STRUCTURE_TYPE_PIPELINE_LAYOUT_CREATE_INFO};
    info.setLayoutCount = 1;
    info.pSetLayouts = &ui.set_layout;
    info.pushConstantRangeCount = 1;
    info.pPushConstantRanges = &push;
    check(vkCreatePipelineLayout(device.handle, &info, nullptr, &ui.layout), "create the UI's pipeline layout");
}

VkShaderModule createModule(Device& device, std::span<const std::uint32_t> spirv) {
    VkShaderModuleCreateInfo info{VK_STRUCTURE_TYPE_SHADER_MODULE_CREATE_INFO};
    info.codeSize = spirv.size_bytes();
    info.pCode = spirv.data();
    VkShaderModule shader = VK_NULL_HANDLE;
    check(vkCreateShaderModule(device.handle, &info, nullptr, &shader), "load the UI's shaders");
    return shader;
}

/// Straight alpha over opaque contents; the attachment's alpha stays 1.
VkPipelineColorBlendAttachmentState alphaBlending() {
    VkPipelineColorBlendAttachmentState blend{};
    blend.blendEnable = VK_TRUE;
    blend.srcColorBlendFactor = VK_BLEND_FACTOR_SRC_ALPHA;
    blend.dstColorBlendFactor = VK_BLEND_FACTOR_ONE_MINUS_SRC_ALPHA;
    blend.colorBlendOp = VK_BLEND_OP_ADD;
    blend.srcAlphaBlendFactor = VK_BLEND_FACTOR_ONE;
    blend.dstAlphaBlendFactor = VK_BLEND_FACTOR_ONE_MINUS_SRC_ALPHA;
    blend.alphaBlendOp = VK_BLEND_OP_ADD;
    blend.colorWriteMask =
        VK_COLOR_COMPONENT_R_BIT | VK_COLOR_COMPONENT_G_BIT | VK_COLOR_COMPONENT_B_BIT | VK_COLOR_COMPONENT_A_BIT;
    return blend;
}

VkPipelineShaderStageCreateInfo stageOf(VkShaderStageFlagBits stage, VkShaderModule shader) {
    VkPipelineShaderStageCreateInfo info{VK_STRUCTURE_TYPE_PIPELINE_SHADER_STAGE_CREATE_INFO};
    info.stage = stage;
    info.module = shader;
    info.pName = "main";
    return info;
}

/// Fixed-function state. Its members point to one another, so it must not be copied.
struct PipelineState {
    VkVertexInputBindingDescription binding{0, sizeof(ImDrawVert), VK_VERTEX_INPUT_RATE_VERTEX};
    VkVertexInputAttributeDescription attributes[3] = {
        {0, 0, VK_FORMAT_R32G32_SFLOAT, offsetof(ImDrawVert, pos)},
        {1, 0, VK_FORMAT_R32G32_SFLOAT, offsetof(ImDrawVert, uv)},
        {2, 0, VK_FORMAT_R8G8B8A8_UNORM, offsetof(ImDrawVert, col)},
    };
    VkPipelineVertexInputStateCreateInfo input{VK_STRUCTURE_TYPE_PIPELINE_VERTEX_INPUT_STATE_CREATE_INFO};
    VkPipelineInputAssemblyStateCreateInfo assembly{VK_STRUCTURE_TYPE_PIPELINE_INPUT_ASSEMBLY_STATE_CREATE_INFO};
    VkPipelineViewportStateCreateInfo viewport{VK_STRUCTURE_TYPE_PIPELINE_VIEWPORT_STATE_CREATE_INFO};
    VkPipelineRasterizationStateCreateInfo raster{VK_STRUCTURE_TYPE_PIPELINE_RASTERIZATION_STATE_CREATE_INFO};
    VkPipelineMultisampleStateCreateInfo samples{VK_STRUCTURE_TYPE_PIPELINE_MULTISAMPLE_STATE_CREATE_INFO};
    VkPipelineColorBlendAttachmentState attachment = alphaBlending();
    VkPipelineColorBlendStateCreateInfo blend{VK_STRUCTURE_TYPE_PIPELINE_COLOR_BLEND_STATE_CREATE_INFO};
    VkDynamicState dynamic_states[2] = {VK_DYNAMIC_STATE_VIEWPORT, VK_DYNAMIC_STATE_SCISSOR};
    VkPipelineDynamicStateCreateInfo dynamic{VK_STRUCTURE_TYPE_PIPELINE_DYNAMIC_STATE_CREATE_INFO};

    PipelineState() {
        input.vertexBindingDescriptionCount = 1;
        input.pVertexBindingDescriptions = &binding;
        input.vertexAttributeDescriptionCount = 3;
        input.pVertexAttributeDescriptions = attributes;
        assembly.topology = VK_PRIMITIVE_TOPOLOGY_TRIANGLE_LIST;
        viewport.viewportCount = viewport.scissorCount = 1;
        raster.polygonMode = VK_POLYGON_MODE_FILL;
        raster.cullMode = VK_CULL_MODE_NONE;
        raster.lineWidth = 1;
        samples.rasterizationSamples = VK_SAMPLE_COUNT_1_BIT;
        blend.attachmentCount = 1;
        blend.pAttachments = &attachment;
        dynamic.dynamicStateCount = 2;
        dynamic.pDynamicStates = dynamic_states;
    }
    PipelineState(const PipelineState&) = delete;
    PipelineState& operator=(const PipelineState&) = delete;
};

VkPipeline createPipeline(Device& device, const UiRenderer& ui, VkShaderModule vertex, VkShaderModule fragment) {
    const PipelineState state;
    const VkPipelineShaderStageCreateInfo stages[] = {stageOf(VK_SHADER_STAGE_VERTEX_BIT, vertex),
                                                      stageOf(VK_SHADER_STAGE_FRAGMENT_BIT, fragment)};
    VkGraphicsPipelineCreateInfo info{VK_STRUCTURE_TYPE_GRAPHICS_PIPELINE_CREATE_INFO};
    info.stageCount = 2;
    info.pStages = stages;
    info.pVertexInputState = &state.input;
    info.pInputAssemblyState = &state.assembly;
    info.pViewportState = &state.viewport;
    info.pRasterizationState = &state.raster;
    info.pMultisampleState = &state.samples;
    info.pColorBlendState = &state.blend;
    info.pDynamicState = &state.dynamic;
    info.layout = ui.layout;
    info.renderPass = ui.pass;
    VkPipeline pipeline = VK_NULL_HANDLE;
    check(vkCreateGraphicsPipelines(device.handle, VK_NULL_HANDLE, 1, &info, nullptr, &pipeline),
          "create the UI's pipeline");
    return pipeline;
}

void createPipeline(Device& device, UiRenderer& ui) {
    const VkShaderModule vertex = createModule(device, ui_vert_spv);
    VkShaderModule fragment = VK_NULL_HANDLE;
    const auto free = [&] {
        vkDestroyShaderModule(device.handle, vertex, nullptr);
        vkDestroyShaderModule(device.handle, fragment, nullptr);
    };
    try {
        fragment = createModule(device, ui_frag_spv);
        ui.pipeline = createPipeline(device, ui, vertex, fragment);
    } catch (...) {
        free();
        throw;
    }
    free();
}

} // namespace

UiRenderer createUiRenderer(Device& device, VkFormat format) {
    UiRenderer ui;
    const OnError undo([&] { destroyUiRenderer(device, ui); });
    ui.pass = createPass(device, format);
    ui.sampler = createLinearSampler(device);
    createSet(device, ui);
    createLayout(device, ui);
    createPipeline(device, ui);
    return ui;
}

void destroyUiRenderer(Device& device, UiRenderer& ui) {
    for (UiBuffers& buffers : ui.buffers) {
        destroyBuffer(device, buffers.vertices);
        destroyBuffer(device, buffers.indices);
    }
    destroyImage(device, ui.font);
    if (ui.pipeline) vkDestroyPipeline(device.handle, ui.pipeline, nullptr);
    if (ui.layout) vkDestroyPipelineLayout(device.handle, ui.layout, nullptr);
    if (ui.pool) vkDestroyDescriptorPool(device.handle, ui.pool, nullptr);
    if (ui.set_layout) vkDestroyDescriptorSetLayout(device.handle, ui.set_layout, nullptr);
    if (ui.sampler) vkDestroySampler(device.handle, ui.sampler, nullptr);
    if (ui.pass) vkDestroyRenderPass(device.handle, ui.pass, nullptr);
    ui = {};
}

} // namespace pointrt

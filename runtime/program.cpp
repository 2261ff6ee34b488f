// SPDX-License-Identifier: Apache-2.0
#include "runtime/program.h"

#include <array>
#include <chrono>
#include <cstdio>
#include <stdexcept>
#include <vector>

#include "pointrt/tool.hpp"

namespace pointrt {
namespace {

constexpr VkDescriptorType kBufferTypes[] = {VK_DESCRIPTOR_TYPE_STORAGE_BUFFER, VK_DESCRIPTOR_TYPE_UNIFORM_BUFFER,
                                             VK_DESCRIPTOR_TYPE_UNIFORM_TEXEL_BUFFER,
                                             VK_DESCRIPTOR_TYPE_STORAGE_TEXEL_BUFFER};
// Of each type, for one set: more than any shader binds.
constexpr std::uint32_t kDescriptorsPerSet = 24;

void createLayouts(Device& device, Program& program) {
    std::vector<VkDescriptorSetLayoutBinding> bindings;
    for (const ShaderBinding& binding : program.shader.bindings)
        bindings.push_back({binding.slot, binding.type, 1, VK_SHADER_STAGE_COMPUTE_BIT, nullptr});
    VkDescriptorSetLayoutCreateInfo set{VK_STRUCTURE_TYPE_DESCRIPTOR_SET_LAYOUT_CREATE_INFO};
    set.bindingCount = static_cast<std::uint32_t>(bindings.size());
    set.pBindings = bindings.data();
    check(vkCreateDescriptorSetLayout(device.handle, &set, nullptr, &program.set_layout), "create a set layout");

    const VkPushConstantRange push{VK_SHADER_STAGE_COMPUTE_BIT, 0, program.shader.push_bytes};
    VkPipelineLayoutCreateInfo layout{VK_STRUCTURE_TYPE_PIPELINE_LAYOUT_CREATE_INFO};
    layout.setLayoutCount = 1;
    layout.pSetLayouts = &program.set_layout;
    layout.pushConstantRangeCount = push.size ? 1 : 0;
    layout.pPushConstantRanges = &push;
    check(vkCreatePipelineLayout(device.handle, &layout, nullptr, &program.layout), "create a pipeline layout");
}

/// Constants 0, 1, 2, ... lie one after the other in the data.
std::vector<VkSpecializationMapEntry> specializationMap(std::size_t count) {
    std::vector<VkSpecializationMapEntry> entries;
    for (std::uint32_t i = 0; i < count; ++i) entries.push_back({i, i * 4u, 4u});
    return entries;
}

void createPipeline(Device& device, Program& program, std::span<const std::uint32_t> spirv,
                    std::initializer_list<std::uint32_t> constants) {
    VkShaderModuleCreateInfo module_info{VK_STRUCTURE_TYPE_SHADER_MODULE_CREATE_INFO};
    module_info.codeSize = spirv.size_bytes();
    module_info.pCode = spirv.data();
    const std::vector<VkSpecializationMapEntry> entries = specializationMap(constants.size());
    const VkSpecializationInfo specialization{static_cast<std::uint32_t>(entries.size()), entries.data(),
                                              constants.size() * sizeof(std::uint32_t), constants.begin()};
    VkComputePipelineCreateInfo info{VK_STRUCTURE_TYPE_COMPUTE_PIPELINE_CREATE_INFO};
    info.stage.sType = VK_STRUCTURE_TYPE_PIPELINE_SHADER_STAGE_CREATE_INFO;
    info.stage.stage = VK_SHADER_STAGE_COMPUTE_BIT;
    info.stage.pName = "main";
    info.stage.pSpecializationInfo = &specialization;
    info.layout = program.layout;

    const std::string what = "build the " + program.name + " pipeline";
    check(vkCreateShaderModule(device.handle, &module_info, nullptr, &info.stage.module), what.c_str());
    const VkResult result =
        vkCreateComputePipelines(device.handle, VK_NULL_HANDLE, 1, &info, nullptr, &program.pipeline);
    vkDestroyShaderModule(device.handle, info.stage.module, nullptr);
    check(result, what.c_str());
}

bool isTexelBuffer(VkDescriptorType type) {
    return type == VK_DESCRIPTOR_TYPE_UNIFORM_TEXEL_BUFFER || type == VK_DESCRIPTOR_TYPE_STORAGE_TEXEL_BUFFER;
}

[[noreturn]] void failBinding(const Program& program, std::uint32_t slot, const char* reason) {
    throw std::logic_error(program.name + ": binding " + std::to_string(slot) + " " + reason);
}

const Buffer& bufferFor(const Program& program, const ShaderBinding& wanted, std::span<const BufferBinding> bindings) {
    for (const BufferBinding& binding : bindings) {
        if (binding.slot != wanted.slot) continue;
        if (!binding.buffer || !binding.buffer->handle) failBinding(program, wanted.slot, "has no buffer");
        if (isTexelBuffer(wanted.type) && !binding.buffer->view) failBinding(program, wanted.slot, "has no view");
        return *binding.buffer;
    }
    failBinding(program, wanted.slot, "is missing");
}

void requireRange(const Device& device, const Program& program, const ShaderBinding& binding, const Buffer& buffer) {
    if (isTexelBuffer(binding.type)) return;
    const std::uint64_t limit = binding.type == VK_DESCRIPTOR_TYPE_STORAGE_BUFFER ? device.limits.maxStorageBufferRange
                                                                                  : device.limits.maxUniformBufferRange;
    if (buffer.bytes > limit)
        throw Error{ExitCode::kCannotRun, program.name + ": a buffer of " + std::to_string(buffer.bytes) +
                                              " bytes, the device binds at most " + std::to_string(limit)};
}

void fillSet(Device& device, const Program& program, VkDescriptorSet set, std::span<const BufferBinding> bindings) {
    const std::size_t count = program.shader.bindings.size();
    std::vector<VkDescriptorBufferInfo> infos(count);
    std::vector<VkWriteDescriptorSet> writes(count, {VK_STRUCTURE_TYPE_WRITE_DESCRIPTOR_SET});
    for (std::size_t i = 0; i < count; ++i) {
        const ShaderBinding& binding = program.shader.bindings[i];
        const Buffer& buffer = bufferFor(program, binding, bindings);
        requireRange(device, program, binding, buffer);
        infos[i] = {buffer.handle, 0, VK_WHOLE_SIZE};
        writes[i].dstSet = set;
        writes[i].dstBinding = binding.slot;
        writes[i].descriptorCount = 1;
        writes[i].descriptorType = binding.type;
        writes[i].pBufferInfo = &infos[i];
        writes[i].pTexelBufferView = &buffer.view;
    }
    vkUpdateDescriptorSets(device.handle, static_cast<std::uint32_t>(count), writes.data(), 0, nullptr);
}

void recordState(VkCommandBuffer commands, const Program& program, VkDescriptorSet set,
                 std::span<const std::byte> push) {
    if (push.size() != program.shader.push_bytes)
        throw std::logic_error(program.name + ": " + std::to_string(push.size()) + " bytes of push constants, " +
                               std::to_string(program.shader.push_bytes) + " in the shader");
    vkCmdBindPipeline(commands, VK_PIPELINE_BIND_POINT_COMPUTE, program.pipeline);
    vkCmdBindDescriptorSets(commands, VK_PIPELINE_BIND_POINT_COMPUTE, program.layout, 0, 1, &set, 0, nullptr);
    if (!push.empty())
        vkCmdPushConstants(commands, program.layout, VK_SHADER_STAGE_COMPUTE_BIT, 0,
                           static_cast<std::uint32_t>(push.size()), push.data());
}

} // namespace

Program createProgram(Device& device, const char* name, std::span<const std::uint32_t> spirv,
                      std::initializer_list<std::uint32_t> constants) {
    const auto start = std::chrono::steady_clock::now();
    Program program;
    program.name = name;
    program.shader = reflectShader(spirv);
    try {
        createLayouts(device, program);
        createPipeline(device, program, spirv, constants);
    } catch (...) {
        destroyProgram(device, program);
        throw;
    }
    const std::chrono::duration<double, std::milli> elapsed = std::chrono::steady_clock::now() - start;
    if (device.verbose) std::fprintf(stderr, "pipeline %s: %.0f ms\n", name, elapsed.count());
    return program;
}

void destroyProgram(Device& device, Program& program) {
    if (program.pipeline) vkDestroyPipeline(device.handle, program.pipeline, nullptr);
    if (program.layout) vkDestroyPipelineLayout(device.handle, program.layout, nullptr);
    if (program.set_layout) vkDestroyDescriptorSetLayout(device.handle, program.set_layout, nullptr);
    program = {};
}

VkDescriptorPool createDescriptorPool(Device& device, std::uint32_t max_sets) {
    std::vector<VkDescriptorPoolSize> sizes;
    for (VkDescriptorType type : kBufferTypes) sizes.push_back({type, max_sets * kDescriptorsPerSet});
    VkDescriptorPoolCreateInfo info{VK_STRUCTURE_TYPE_DESCRIPTOR_POOL_CREATE_INFO};
    info.maxSets = max_sets;
    info.poolSizeCount = static_cast<std::uint32_t>(sizes.size());
    info.pPoolSizes = sizes.data();
    VkDescriptorPool pool = VK_NULL_HANDLE;
    check(vkCreateDescriptorPool(device.handle, &info, nullptr, &pool), "create a descriptor pool");
    return pool;
}

void destroyDescriptorPool(Device& device, VkDescriptorPool& pool) {
    if (pool) vkDestroyDescriptorPool(device.handle, pool, nullptr);
    pool = VK_NULL_HANDLE;
}

VkDescriptorSet createDescriptorSet(Device& device, VkDescriptorPool pool, const Program& program,
                                    std::initializer_list<BufferBinding> bindings) {
    return createDescriptorSet(device, pool, program, std::span(bindings.begin(), bindings.size()));
}

VkDescriptorSet createDescriptorSet(Device& device, VkDescriptorPool pool, const Program& program,
                                    std::span<const BufferBinding> bindings) {
    if (bindings.size() != program.shader.bindings.size())
        throw std::logic_error(program.name + ": " + std::to_string(bindings.size()) + " bindings given, " +
                               std::to_string(program.shader.bindings.size()) + " in the shader");
    VkDescriptorSetAllocateInfo info{VK_STRUCTURE_TYPE_DESCRIPTOR_SET_ALLOCATE_INFO};
    info.descriptorPool = pool;
    info.descriptorSetCount = 1;
    info.pSetLayouts = &program.set_layout;
    VkDescriptorSet set = VK_NULL_HANDLE;
    check(vkAllocateDescriptorSets(device.handle, &info, &set), "allocate a descriptor set");
    fillSet(device, program, set, bindings);
    return set;
}

void recordDispatch(VkCommandBuffer commands, const Program& program, VkDescriptorSet set,
                    std::span<const std::byte> push, GroupCount groups) {
    recordState(commands, program, set, push);
    vkCmdDispatch(commands, groups.x, groups.y, groups.z);
}

void recordDispatchIndirect(VkCommandBuffer commands, const Program& program, VkDescriptorSet set,
                            std::span<const std::byte> push, const Buffer& arguments, std::uint64_t offset) {
    recordState(commands, program, set, push);
    vkCmdDispatchIndirect(commands, arguments.handle, offset);
}

void recordBarrier(VkCommandBuffer commands) {
    VkMemoryBarrier barrier{VK_STRUCTURE_TYPE_MEMORY_BARRIER};
    barrier.srcAccessMask = VK_ACCESS_SHADER_WRITE_BIT | VK_ACCESS_TRANSFER_WRITE_BIT;
    barrier.dstAccessMask = VK_ACCESS_SHADER_READ_BIT | VK_ACCESS_SHADER_WRITE_BIT |
                            VK_ACCESS_INDIRECT_COMMAND_READ_BIT | VK_ACCESS_TRANSFER_READ_BIT |
                            VK_ACCESS_TRANSFER_WRITE_BIT;
    const VkPipelineStageFlags writers = VK_PIPELINE_STAGE_COMPUTE_SHADER_BIT | VK_PIPELINE_STAGE_TRANSFER_BIT;
    vkCmdPipelineBarrier(commands, writers, writers | VK_PIPELINE_STAGE_DRAW_INDIRECT_BIT, 0, 1, &barrier, 0, nullptr,
                         0, nullptr);
}

} // namespace pointrt

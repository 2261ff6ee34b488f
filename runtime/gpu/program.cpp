// SPDX-License-Identifier: Apache-2.0
#include "runtime/gpu/program.h"

#define XXH_INLINE_ALL
#include <xxhash.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <cstdio>
#include <stdexcept>
#include <vector>

#include "format/base/error.h"
#include "runtime/gpu/pipeline_cache.h"
#include "runtime/gpu/program_store.h"
#include "runtime/util/on_error.h"

namespace pointrt {
namespace {

constexpr VkDescriptorType kBufferTypes[] = {VK_DESCRIPTOR_TYPE_STORAGE_BUFFER, VK_DESCRIPTOR_TYPE_UNIFORM_BUFFER,
                                             VK_DESCRIPTOR_TYPE_UNIFORM_TEXEL_BUFFER,
                                             VK_DESCRIPTOR_TYPE_STORAGE_TEXEL_BUFFER};
// Descriptors of each type for one set: more than any shader binds.
constexpr std::uint32_t kDescriptorsPerSet = 64;

std::uint32_t number(gpu::Binding slot) { return static_cast<std::uint32_t>(slot); }

std::vector<ShaderBinding> bindingsOf(const Program& program, std::uint32_t set) {
    std::vector<ShaderBinding> bindings;
    for (const ShaderBinding& binding : program.shader.bindings)
        if (binding.set == set) bindings.push_back(binding);
    return bindings;
}

void createSetLayout(Device& device, const std::vector<ShaderBinding>& declared, VkDescriptorSetLayout& layout) {
    std::vector<VkDescriptorSetLayoutBinding> bindings;
    for (const ShaderBinding& binding : declared)
        bindings.push_back({number(binding.slot), binding.type, binding.count, VK_SHADER_STAGE_COMPUTE_BIT, nullptr});
    VkDescriptorSetLayoutCreateInfo set{VK_STRUCTURE_TYPE_DESCRIPTOR_SET_LAYOUT_CREATE_INFO};
    set.bindingCount = static_cast<std::uint32_t>(bindings.size());
    set.pBindings = bindings.data();
    check(vkCreateDescriptorSetLayout(device.handle, &set, nullptr, &layout), "create a set layout");
}

std::uint32_t setCount(const Program& program) {
    const auto& bindings = program.shader.bindings;
    return bindings.empty() ? 1 : bindings.back().set + 1;
}

std::uint32_t countOf(const Program& program, VkDescriptorType type) {
    std::uint32_t count = 0;
    for (const ShaderBinding& binding : program.shader.bindings)
        if (binding.type == type) count += binding.count;
    return count;
}

void requireDescriptors(const Device& device, const Program& program) {
    const VkPhysicalDeviceLimits& limits = device.limits;
    const struct {
        VkDescriptorType type;
        const char* what;
        std::uint32_t limit;
    } kinds[] = {
        {VK_DESCRIPTOR_TYPE_STORAGE_TEXEL_BUFFER, "storage texel buffers", limits.maxPerStageDescriptorStorageImages},
        {VK_DESCRIPTOR_TYPE_UNIFORM_TEXEL_BUFFER, "texel buffers", limits.maxPerStageDescriptorSampledImages},
        {VK_DESCRIPTOR_TYPE_STORAGE_BUFFER, "storage buffers", limits.maxPerStageDescriptorStorageBuffers},
        {VK_DESCRIPTOR_TYPE_UNIFORM_BUFFER, "uniform buffers", limits.maxPerStageDescriptorUniformBuffers}};
    const char* needs = setCount(program) > 1 ? ": a scene of this size needs " : ": the program needs ";
    for (const auto& each : kinds)
        if (const std::uint32_t count = countOf(program, each.type); count > each.limit)
            throw Error{ExitCode::kCannotRun, program.name + needs + std::to_string(count) + " " + each.what +
                                                  ", the limit of the device is " + std::to_string(each.limit)};
}

void createLayouts(Device& device, Program& program) {
    requireDescriptors(device, program);
    for (std::uint32_t set = 0; set < setCount(program); ++set)
        createSetLayout(device, bindingsOf(program, set), program.set_layouts[set]);
    const VkPushConstantRange push{VK_SHADER_STAGE_COMPUTE_BIT, 0, program.shader.push_bytes};
    VkPipelineLayoutCreateInfo layout{VK_STRUCTURE_TYPE_PIPELINE_LAYOUT_CREATE_INFO};
    layout.setLayoutCount = setCount(program);
    layout.pSetLayouts = program.set_layouts.data();
    layout.pushConstantRangeCount = push.size ? 1 : 0;
    layout.pPushConstantRanges = &push;
    check(vkCreatePipelineLayout(device.handle, &layout, nullptr, &program.layout), "create a pipeline layout");
    nameObject(device, VK_OBJECT_TYPE_PIPELINE_LAYOUT, program.layout, program.name.c_str());
}

/// Requires a value for each constant of the shader.
void requireConstants(const std::string& name, const ShaderInterface& shader, std::span<const SpecConstant> constants) {
    for (const gpu::SpecId id : shader.constants)
        if (std::none_of(constants.begin(), constants.end(), [&](const SpecConstant& each) { return each.id == id; }))
            throw std::logic_error(name + ": specialization constant " +
                                   std::to_string(static_cast<std::uint32_t>(id)) + " has no value");
}

/// Ignores constants that the shader does not declare.
ProgramKey keyOf(const char* name, std::span<const std::uint32_t> spirv, const ShaderInterface& shader,
                 std::span<const SpecConstant> constants) {
    ProgramKey key{name, spirv.size_bytes(), XXH3_64bits(spirv.data(), spirv.size_bytes()), {}};
    for (const SpecConstant& each : constants)
        if (std::find(shader.constants.begin(), shader.constants.end(), each.id) != shader.constants.end())
            key.constants.emplace_back(static_cast<std::uint32_t>(each.id), each.value);
    std::sort(key.constants.begin(), key.constants.end());
    return key;
}

/// Locates the values in the list.
std::vector<VkSpecializationMapEntry> specializationMap(std::span<const SpecConstant> constants) {
    std::vector<VkSpecializationMapEntry> entries;
    for (std::size_t i = 0; i < constants.size(); ++i)
        entries.push_back({static_cast<std::uint32_t>(constants[i].id),
                           static_cast<std::uint32_t>(i * sizeof(SpecConstant) + offsetof(SpecConstant, value)),
                           sizeof(SpecConstant::value)});
    return entries;
}

void createPipeline(Device& device, Program& program, std::span<const std::uint32_t> spirv,
                    std::span<const SpecConstant> constants) {
    VkShaderModuleCreateInfo module_info{VK_STRUCTURE_TYPE_SHADER_MODULE_CREATE_INFO};
    module_info.codeSize = spirv.size_bytes();
    module_info.pCode = spirv.data();
    const std::vector<VkSpecializationMapEntry> entries = specializationMap(constants);
    const VkSpecializationInfo specialization{static_cast<std::uint32_t>(entries.size()), entries.data(),
                                              constants.size_bytes(), constants.data()};
    VkComputePipelineCreateInfo info{VK_STRUCTURE_TYPE_COMPUTE_PIPELINE_CREATE_INFO};
    info.stage.sType = VK_STRUCTURE_TYPE_PIPELINE_SHADER_STAGE_CREATE_INFO;
    info.stage.stage = VK_SHADER_STAGE_COMPUTE_BIT;
    info.stage.pName = "main";
    info.stage.pSpecializationInfo = &specialization;
    VkPipelineShaderStageRequiredSubgroupSizeCreateInfoEXT subgroup{
        VK_STRUCTURE_TYPE_PIPELINE_SHADER_STAGE_REQUIRED_SUBGROUP_SIZE_CREATE_INFO_EXT};
    subgroup.requiredSubgroupSize = device.subgroup_size;
    if (device.sets_subgroup_size) info.stage.pNext = &subgroup;
    info.layout = program.layout;

    const std::string what = "build the " + program.name + " pipeline";
    check(vkCreateShaderModule(device.handle, &module_info, nullptr, &info.stage.module), what.c_str());
    const VkResult result =
        vkCreateComputePipelines(device.handle, device.pipelines->handle(), 1, &info, nullptr, &program.pipeline);
    vkDestroyShaderModule(device.handle, info.stage.module, nullptr);
    check(result, what.c_str());
    nameObject(device, VK_OBJECT_TYPE_PIPELINE, program.pipeline, program.name.c_str());
}

Program buildProgram(Device& device, const char* name, std::span<const std::uint32_t> spirv,
                     const ShaderInterface& shader, std::span<const SpecConstant> constants) {
    const auto start = std::chrono::steady_clock::now();
    Program program;
    program.name = name;
    program.shader = shader;
    const OnError undo([&] { freeProgram(device, program); });
    createLayouts(device, program);
    createPipeline(device, program, spirv, constants);
    const std::chrono::duration<double, std::milli> elapsed = std::chrono::steady_clock::now() - start;
    if (device.verbose) std::fprintf(stderr, "pipeline %s: %.0f ms\n", name, elapsed.count());
    return program;
}

bool isTexelBuffer(VkDescriptorType type) {
    return type == VK_DESCRIPTOR_TYPE_UNIFORM_TEXEL_BUFFER || type == VK_DESCRIPTOR_TYPE_STORAGE_TEXEL_BUFFER;
}

bool isTree(VkDescriptorType type) { return type == VK_DESCRIPTOR_TYPE_ACCELERATION_STRUCTURE_KHR; }

[[noreturn]] void failBinding(const Program& program, gpu::Binding slot, const char* reason) {
    throw std::logic_error(program.name + ": binding " + std::to_string(number(slot)) + " " + reason);
}

/// Requires a buffer and, for texel buffers, the view by which they are bound.
void requireView(const Program& program, const ShaderBinding& wanted, const Buffer& buffer) {
    if (!buffer.handle) failBinding(program, wanted.slot, "has no buffer");
    if (isTexelBuffer(wanted.type) && !buffer.view) failBinding(program, wanted.slot, "has no view");
    if (isTree(wanted.type) && !buffer.tree) failBinding(program, wanted.slot, "has no acceleration structure");
}

const BufferBinding& bindingFor(const Program& program, const ShaderBinding& wanted,
                                std::span<const BufferBinding> bindings) {
    for (const BufferBinding& binding : bindings) {
        if (binding.slot != wanted.slot) continue;
        if (!binding.buffer) failBinding(program, wanted.slot, "has no buffer");
        if (binding.count > wanted.count) failBinding(program, wanted.slot, "has fewer elements than buffers");
        return binding;
    }
    failBinding(program, wanted.slot, "is missing");
}

void requireRange(const Device& device, const Program& program, const ShaderBinding& binding, const Buffer& buffer) {
    if (isTexelBuffer(binding.type)) return;
    const std::uint64_t limit = binding.type == VK_DESCRIPTOR_TYPE_STORAGE_BUFFER ? device.limits.maxStorageBufferRange
                                                                                  : device.limits.maxUniformBufferRange;
    if (buffer.bytes > limit)
        throw Error{ExitCode::kCannotRun, program.name + ": a buffer of " + std::to_string(buffer.bytes) +
                                              " bytes, the limit of the device is " + std::to_string(limit)};
}

/// The buffers, views or acceleration structures that the descriptors of one binding refer to.
struct Named {
    std::vector<VkDescriptorBufferInfo> infos;
    std::vector<VkBufferView> views;
    VkAccelerationStructureKHR tree = VK_NULL_HANDLE;
    VkWriteDescriptorSetAccelerationStructureKHR tree_write{
        VK_STRUCTURE_TYPE_WRITE_DESCRIPTOR_SET_ACCELERATION_STRUCTURE_KHR};
};

Named namedBy(const Device& device, const Program& program, const ShaderBinding& wanted, const BufferBinding& given) {
    Named named;
    for (std::uint32_t k = 0; k < wanted.count; ++k) {
        const Buffer& buffer = given.buffer[k < given.count ? k : 0];
        requireView(program, wanted, buffer);
        requireRange(device, program, wanted, buffer);
        named.infos.push_back({buffer.handle, 0, VK_WHOLE_SIZE});
        named.views.push_back(buffer.view);
    }
    named.tree = given.buffer->tree;
    return named;
}

void fillSet(Device& device, const Program& program, VkDescriptorSet set, std::span<const ShaderBinding> wanted,
             std::span<const BufferBinding> bindings) {
    std::vector<Named> named;
    for (const ShaderBinding& each : wanted)
        named.push_back(namedBy(device, program, each, bindingFor(program, each, bindings)));
    std::vector<VkWriteDescriptorSet> writes(wanted.size(), {VK_STRUCTURE_TYPE_WRITE_DESCRIPTOR_SET});
    for (std::size_t i = 0; i < wanted.size(); ++i) {
        writes[i].dstSet = set;
        writes[i].dstBinding = number(wanted[i].slot);
        writes[i].descriptorCount = wanted[i].count;
        writes[i].descriptorType = wanted[i].type;
        writes[i].pBufferInfo = named[i].infos.data();
        writes[i].pTexelBufferView = named[i].views.data();
        named[i].tree_write.accelerationStructureCount = 1;
        named[i].tree_write.pAccelerationStructures = &named[i].tree;
        if (isTree(wanted[i].type)) writes[i].pNext = &named[i].tree_write;
    }
    vkUpdateDescriptorSets(device.handle, static_cast<std::uint32_t>(writes.size()), writes.data(), 0, nullptr);
}

void recordState(VkCommandBuffer commands, const Program& program, const DescriptorSets& sets,
                 std::span<const std::byte> push) {
    if (!program.pipeline) throw std::logic_error("dispatch of a program that was not built");
    const std::uint32_t declared = program.shader.push_bytes;
    if (declared != 0 && push.size() != declared)
        throw std::logic_error(program.name + ": " + std::to_string(push.size()) + " bytes of push constants, " +
                               std::to_string(declared) + " in the shader");
    if (setCount(program) > 1 && !sets.sets[1]) throw std::logic_error(program.name + ": its pages are not bound");
    vkCmdBindPipeline(commands, VK_PIPELINE_BIND_POINT_COMPUTE, program.pipeline);
    vkCmdBindDescriptorSets(commands, VK_PIPELINE_BIND_POINT_COMPUTE, program.layout, 0, setCount(program),
                            sets.sets.data(), 0, nullptr);
    if (declared != 0)
        vkCmdPushConstants(commands, program.layout, VK_SHADER_STAGE_COMPUTE_BIT, 0,
                           static_cast<std::uint32_t>(push.size()), push.data());
}

} // namespace

Program createProgram(Device& device, const char* name, std::span<const std::uint32_t> spirv,
                      std::initializer_list<SpecConstant> constants) {
    return createProgram(device, name, spirv, std::span(constants.begin(), constants.size()));
}

Program createProgram(Device& device, const char* name, std::span<const std::uint32_t> spirv,
                      std::span<const SpecConstant> constants) {
    const ShaderInterface shader = reflectShader(spirv);
    requireConstants(name, shader, constants);
    return device.programs->take(device, keyOf(name, spirv, shader, constants),
                                 [&] { return buildProgram(device, name, spirv, shader, constants); });
}

void destroyProgram(Device& device, Program& program) {
    if (program.pipeline) device.programs->release(device, program);
    program = {};
}

void freeProgram(Device& device, Program& program) {
    finishSubmitted(device);
    if (program.pipeline) vkDestroyPipeline(device.handle, program.pipeline, nullptr);
    if (program.layout) vkDestroyPipelineLayout(device.handle, program.layout, nullptr);
    for (VkDescriptorSetLayout layout : program.set_layouts)
        if (layout) vkDestroyDescriptorSetLayout(device.handle, layout, nullptr);
    program = {};
}

VkDescriptorPool createDescriptorPool(Device& device, std::uint32_t max_sets) {
    std::vector<VkDescriptorPoolSize> sizes;
    for (VkDescriptorType type : kBufferTypes) sizes.push_back({type, max_sets * kDescriptorsPerSet});
    if (device.queries_rays) sizes.push_back({VK_DESCRIPTOR_TYPE_ACCELERATION_STRUCTURE_KHR, max_sets});
    VkDescriptorPoolCreateInfo info{VK_STRUCTURE_TYPE_DESCRIPTOR_POOL_CREATE_INFO};
    info.maxSets = max_sets;
    info.poolSizeCount = static_cast<std::uint32_t>(sizes.size());
    info.pPoolSizes = sizes.data();
    VkDescriptorPool pool = VK_NULL_HANDLE;
    check(vkCreateDescriptorPool(device.handle, &info, nullptr, &pool), "create a descriptor pool");
    return pool;
}

void destroyDescriptorPool(Device& device, VkDescriptorPool& pool) {
    if (pool) finishSubmitted(device);
    if (pool) vkDestroyDescriptorPool(device.handle, pool, nullptr);
    pool = VK_NULL_HANDLE;
}

VkDescriptorSet createDescriptorSet(Device& device, VkDescriptorPool pool, const Program& program,
                                    std::initializer_list<BufferBinding> bindings) {
    return createDescriptorSet(device, pool, program, std::span(bindings.begin(), bindings.size()));
}

VkDescriptorSet createDescriptorSet(Device& device, VkDescriptorPool pool, const Program& program,
                                    std::span<const BufferBinding> bindings, std::uint32_t set_number) {
    const std::vector<ShaderBinding> wanted = bindingsOf(program, set_number);
    if (bindings.size() != wanted.size())
        throw std::logic_error(program.name + ": " + std::to_string(bindings.size()) + " bindings given, " +
                               std::to_string(wanted.size()) + " in the shader");
    VkDescriptorSetAllocateInfo info{VK_STRUCTURE_TYPE_DESCRIPTOR_SET_ALLOCATE_INFO};
    info.descriptorPool = pool;
    info.descriptorSetCount = 1;
    info.pSetLayouts = &program.set_layouts.at(set_number);
    VkDescriptorSet set = VK_NULL_HANDLE;
    check(vkAllocateDescriptorSets(device.handle, &info, &set), "allocate a descriptor set");
    fillSet(device, program, set, wanted, bindings);
    return set;
}

void recordDispatch(VkCommandBuffer commands, const Program& program, const DescriptorSets& sets,
                    std::span<const std::byte> push, GroupCount groups) {
    recordState(commands, program, sets, push);
    vkCmdDispatch(commands, groups.x, groups.y, groups.z);
}

void recordDispatchIndirect(VkCommandBuffer commands, const Program& program, const DescriptorSets& sets,
                            std::span<const std::byte> push, const Buffer& arguments, std::uint64_t offset) {
    recordState(commands, program, sets, push);
    vkCmdDispatchIndirect(commands, arguments.handle, offset);
}

void recordBarrier(VkCommandBuffer commands) {
    VkMemoryBarrier barrier{VK_STRUCTURE_TYPE_MEMORY_BARRIER};
    barrier.srcAccessMask = VK_ACCESS_SHADER_WRITE_BIT | VK_ACCESS_TRANSFER_WRITE_BIT;
    barrier.dstAccessMask = VK_ACCESS_SHADER_READ_BIT | VK_ACCESS_SHADER_WRITE_BIT | VK_ACCESS_UNIFORM_READ_BIT |
                            VK_ACCESS_INDIRECT_COMMAND_READ_BIT | VK_ACCESS_TRANSFER_READ_BIT |
                            VK_ACCESS_TRANSFER_WRITE_BIT;
    const VkPipelineStageFlags writers = VK_PIPELINE_STAGE_COMPUTE_SHADER_BIT | VK_PIPELINE_STAGE_TRANSFER_BIT;
    vkCmdPipelineBarrier(commands, writers, writers | VK_PIPELINE_STAGE_DRAW_INDIRECT_BIT, 0, 1, &barrier, 0, nullptr,
                         0, nullptr);
}

} // namespace pointrt

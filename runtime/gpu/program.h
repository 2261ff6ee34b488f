// SPDX-License-Identifier: Apache-2.0
// Compute programs: a pipeline from embedded SPIR-V whose bindings are declared in the shader alone.
#pragma once

#include <array>
#include <cstdint>
#include <initializer_list>
#include <span>
#include <string>

#include "runtime/gpu/device.h"
#include "runtime/gpu/resources.h"
#include "runtime/gpu/spirv.h"

namespace pointrt {

/// A compute pipeline and what its shader declares, from its device's store. Give it back with destroyProgram.
struct Program {
    std::string name; ///< for messages
    VkPipeline pipeline = VK_NULL_HANDLE;
    VkPipelineLayout layout = VK_NULL_HANDLE;
    std::array<VkDescriptorSetLayout, 2> set_layouts{}; ///< the second only where the shader declares set 1
    ShaderInterface shader;
};

/// A specialization constant's value (floats by std::bit_cast).
struct SpecConstant {
    gpu::SpecId id{};
    std::uint32_t value = 0;
};

/// One binding: its place in the shader and the buffer behind it (with a view for texel buffers), or the first of
/// count buffers for an array; what elements the array has beyond get the first one again.
struct BufferBinding {
    gpu::Binding slot{};
    const Buffer* buffer = nullptr;
    std::uint32_t count = 1;
};

/// Builds the pipeline, or takes the one that the device's store has of the same code and values. constants have a
/// value for each specialization constant that the shader declares, and may have more: programs of a family take what
/// they know from one list. Throws std::logic_error where a value is missing, Error kCannotRun where the driver
/// refuses.
Program createProgram(Device& device, const char* name, std::span<const std::uint32_t> spirv,
                      std::initializer_list<SpecConstant> constants = {});
Program createProgram(Device& device, const char* name, std::span<const std::uint32_t> spirv,
                      std::span<const SpecConstant> constants);
/// Gives the program back to the store, which keeps some that nobody uses (program_store.h).
void destroyProgram(Device& device, Program& program);

/// A pool for up to max_sets descriptor sets; they are freed with the pool.
VkDescriptorPool createDescriptorPool(Device& device, std::uint32_t max_sets);
void destroyDescriptorPool(Device& device, VkDescriptorPool& pool);

/// What a dispatch binds: set 1 for programs that declare it, and may stay null for others.
struct DescriptorSets {
    DescriptorSets(VkDescriptorSet first = VK_NULL_HANDLE, VkDescriptorSet second = VK_NULL_HANDLE)
        : sets{first, second} {}
    std::array<VkDescriptorSet, 2> sets;
};

/// A descriptor set (0 or 1) with every binding that program has there filled. Throws std::logic_error when bindings do
/// not match what the shader declares, Error kCannotRun when a buffer is larger than the device can bind.
VkDescriptorSet createDescriptorSet(Device& device, VkDescriptorPool pool, const Program& program,
                                    std::initializer_list<BufferBinding> bindings);
VkDescriptorSet createDescriptorSet(Device& device, VkDescriptorPool pool, const Program& program,
                                    std::span<const BufferBinding> bindings, std::uint32_t set = 0);

/// Workgroups in each direction.
struct GroupCount {
    std::uint32_t x = 1, y = 1, z = 1;
};

/// Records binding, push constants and dispatch. push must have exactly the size of the shader's push block and the
/// sets that the program declares must be there: std::logic_error otherwise. Where the shader has no push block,
/// perhaps because it does not use it, push goes nowhere.
void recordDispatch(VkCommandBuffer commands, const Program& program, const DescriptorSets& sets,
                    std::span<const std::byte> push, GroupCount groups);
/// The same with the group counts read on the device: 3 uint32 at offset (a multiple of 4) of arguments.
void recordDispatchIndirect(VkCommandBuffer commands, const Program& program, const DescriptorSets& sets,
                            std::span<const std::byte> push, const Buffer& arguments, std::uint64_t offset);

/// The bytes of a plain struct as push constants.
template <typename T>
std::span<const std::byte> pushBytes(const T& value) {
    return std::as_bytes(std::span<const T, 1>(&value, 1));
}

/// What compute shaders and transfers wrote before is seen by compute shaders, indirect dispatches and transfers after.
void recordBarrier(VkCommandBuffer commands);

} // namespace pointrt

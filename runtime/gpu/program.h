// SPDX-License-Identifier: Apache-2.0
// Compute programs: pipelines from embedded SPIR-V. Bindings are declared in the shaders only.
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

/// A compute pipeline from the device's store, and the interface of its shader. Release it with destroyProgram.
struct Program {
    std::string name; ///< for messages
    VkPipeline pipeline = VK_NULL_HANDLE;
    VkPipelineLayout layout = VK_NULL_HANDLE;
    std::array<VkDescriptorSetLayout, 2> set_layouts{}; ///< the second only if the shader declares set 1
    ShaderInterface shader;
};

/// The value of a specialization constant (floats by std::bit_cast).
struct SpecConstant {
    gpu::SpecId id{};
    std::uint32_t value = 0;
};

/// A binding and its buffer (with a view for texel buffers, or its acceleration structure), or the first of count
/// consecutive buffers for an array; further elements of the array get the first buffer again.
struct BufferBinding {
    gpu::Binding slot{};
    const Buffer* buffer = nullptr;
    std::uint32_t count = 1;
};

/// Builds the pipeline, or takes one with the same code and constants from the device's store.
/// @param constants a value for each specialization constant of the shader; may have others.
/// Throws std::logic_error if a value is missing, Error kCannotRun if the driver cannot build the pipeline.
Program createProgram(Device& device, const char* name, std::span<const std::uint32_t> spirv,
                      std::initializer_list<SpecConstant> constants = {});
Program createProgram(Device& device, const char* name, std::span<const std::uint32_t> spirv,
                      std::span<const SpecConstant> constants);
/// Releases the program to the store, which keeps some unused ones (program_store.h).
void destroyProgram(Device& device, Program& program);

/// A pool for up to max_sets descriptor sets, which are freed with it, after this thread's submissions.
VkDescriptorPool createDescriptorPool(Device& device, std::uint32_t max_sets);
void destroyDescriptorPool(Device& device, VkDescriptorPool& pool);

/// The sets that a dispatch binds. Set 1 may be null for programs that do not declare it.
struct DescriptorSets {
    DescriptorSets(VkDescriptorSet first = VK_NULL_HANDLE, VkDescriptorSet second = VK_NULL_HANDLE)
        : sets{first, second} {}
    std::array<VkDescriptorSet, 2> sets;
};

/// A descriptor set (0 or 1) for all of the program's bindings in it. Throws std::logic_error if bindings do not match
/// the shader, Error kCannotRun if a buffer is larger than the device can bind.
VkDescriptorSet createDescriptorSet(Device& device, VkDescriptorPool pool, const Program& program,
                                    std::initializer_list<BufferBinding> bindings);
VkDescriptorSet createDescriptorSet(Device& device, VkDescriptorPool pool, const Program& program,
                                    std::span<const BufferBinding> bindings, std::uint32_t set = 0);

/// Workgroups in each direction.
struct GroupCount {
    std::uint32_t x = 1, y = 1, z = 1;
};

/// Records binding, push constants and dispatch. Throws std::logic_error if the size of push differs from the shader's
/// push block or a declared set is missing. If the shader has no push block (it may have been optimised away), push is
/// ignored.
void recordDispatch(VkCommandBuffer commands, const Program& program, const DescriptorSets& sets,
                    std::span<const std::byte> push, GroupCount groups);
/// The same with the group counts read from a buffer: 3 uint32 at offset (a multiple of 4) of arguments.
void recordDispatchIndirect(VkCommandBuffer commands, const Program& program, const DescriptorSets& sets,
                            std::span<const std::byte> push, const Buffer& arguments, std::uint64_t offset);

/// Push constants from a plain struct.
template <typename T>
std::span<const std::byte> pushBytes(const T& value) {
    return std::as_bytes(std::span<const T, 1>(&value, 1));
}

/// Makes earlier writes of compute shaders and transfers visible to later compute shaders, indirect dispatches and
/// transfers.
void recordBarrier(VkCommandBuffer commands);

} // namespace pointrt

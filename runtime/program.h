// SPDX-License-Identifier: Apache-2.0
// Compute programs: a pipeline from embedded SPIR-V whose bindings are declared in the shader alone.
#pragma once

#include <cstdint>
#include <initializer_list>
#include <span>
#include <string>

#include "runtime/device.h"
#include "runtime/resources.h"
#include "runtime/spirv.h"

namespace pointrt {

/// A compute pipeline and what its shader declares. Free it with destroyProgram.
struct Program {
    std::string name; ///< for messages
    VkPipeline pipeline = VK_NULL_HANDLE;
    VkPipelineLayout layout = VK_NULL_HANDLE;
    VkDescriptorSetLayout set_layout = VK_NULL_HANDLE;
    ShaderInterface shader;
};

/// One descriptor: the shader's binding number and the buffer behind it (with a view for texel buffers).
struct BufferBinding {
    std::uint32_t slot = 0;
    const Buffer* buffer = nullptr;
};

/// Builds the pipeline. constants are the values of specialization constants 0, 1, 2, ... (floats by std::bit_cast).
/// Throws Error kCannotRun where the driver refuses.
Program createProgram(Device& device, const char* name, std::span<const std::uint32_t> spirv,
                      std::initializer_list<std::uint32_t> constants = {});
void destroyProgram(Device& device, Program& program);

/// A pool for up to max_sets descriptor sets; they are freed with the pool.
VkDescriptorPool createDescriptorPool(Device& device, std::uint32_t max_sets);
void destroyDescriptorPool(Device& device, VkDescriptorPool& pool);

/// A descriptor set with every binding of program filled. Throws std::logic_error when bindings do not match what the
/// shader declares, Error kCannotRun when a buffer is larger than the device can bind.
VkDescriptorSet createDescriptorSet(Device& device, VkDescriptorPool pool, const Program& program,
                                    std::initializer_list<BufferBinding> bindings);
VkDescriptorSet createDescriptorSet(Device& device, VkDescriptorPool pool, const Program& program,
                                    std::span<const BufferBinding> bindings);

/// Workgroups in each direction.
struct GroupCount {
    std::uint32_t x = 1, y = 1, z = 1;
};

/// Records binding, push constants and dispatch. push must have exactly the size of the shader's push block (empty
/// where it has none): std::logic_error otherwise.
void recordDispatch(VkCommandBuffer commands, const Program& program, VkDescriptorSet set,
                    std::span<const std::byte> push, GroupCount groups);
/// The same with the group counts read on the device: 3 uint32 at offset (a multiple of 4) of arguments.
void recordDispatchIndirect(VkCommandBuffer commands, const Program& program, VkDescriptorSet set,
                            std::span<const std::byte> push, const Buffer& arguments, std::uint64_t offset);

/// The bytes of a plain struct as push constants.
template <typename T>
std::span<const std::byte> pushBytes(const T& value) {
    return std::as_bytes(std::span<const T, 1>(&value, 1));
}

/// What compute shaders and transfers wrote before is seen by compute shaders, indirect dispatches and transfers after.
void recordBarrier(VkCommandBuffer commands);

} // namespace pointrt

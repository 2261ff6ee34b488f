// SPDX-License-Identifier: Apache-2.0
// SPIR-V reflection for compute programs.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "runtime/gpu/vulkan.h"
#include "shaders/shared/bindings.h"
#include "shaders/shared/spec_constants.h"

namespace pointrt {

/// A buffer, an array of them, or an acceleration structure, that the shader declares in descriptor set 0 or 1.
struct ShaderBinding {
    gpu::Binding slot{};
    VkDescriptorType type =
        VK_DESCRIPTOR_TYPE_STORAGE_BUFFER; ///< or uniform, uniform texel, storage texel buffer, acceleration structure
    std::uint32_t set = 0;
    std::uint32_t count = 1; ///< elements of the array
};

struct ShaderInterface {
    std::vector<ShaderBinding> bindings; ///< by set, then by slot, ascending
    std::vector<gpu::SpecId> constants;  ///< specialization constants, ascending
    std::uint32_t push_bytes = 0;        ///< size of the push constant block; 0: none
};

/// Reads bindings, specialization constants and push constant size from a module. Follows the SPIR-V
/// specification 1.5, sections 2.3 (physical layout) and 3.42 (instructions). Throws std::logic_error on descriptors
/// other than buffers, their arrays and acceleration structures in sets 0 and 1: embedded shaders are ours, so that is
/// a bug.
ShaderInterface reflectShader(std::span<const std::uint32_t> spirv);

} // namespace pointrt

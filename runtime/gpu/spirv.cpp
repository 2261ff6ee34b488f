// SPDX-License-Identifier: Apache-2.0
#include "runtime/gpu/spirv.h"

#include <algorithm>
#include <stdexcept>
#include <string>
#include <utility>

namespace pointrt {
namespace {

// SPIR-V 1.5: opcodes (3.42), storage classes (3.7), decorations (3.20), Dim (3.8).
enum Opcode : std::uint32_t {
    kOpTypeInt = 21,
    kOpTypeFloat = 22,
    kOpTypeVector = 23,
    kOpTypeImage = 25,
    kOpTypeSampledImage = 27,
    kOpTypeArray = 28,
    kOpTypeStruct = 30,
    kOpTypePointer = 32,
    kOpConstant = 43,
    kOpVariable = 59,
    kOpDecorate = 71,
    kOpMemberDecorate = 72,
    kOpTypeAccelerationStructure = 5341
};
enum StorageClass : std::uint32_t { kUniformConstant = 0, kUniform = 2, kPushConstant = 9, kStorageBuffer = 12 };
enum Decoration : std::uint32_t {
    kSpecId = 1,
    kBufferBlock = 3,
    kArrayStride = 6,
    kBinding = 33,
    kDescriptorSet = 34,
    kMemberOffset = 35
};
constexpr std::uint32_t kDimBuffer = 5;
constexpr std::uint32_t kImageSampled = 1; // 2, for a buffer, means storage
constexpr std::size_t kHeaderWords = 5;
constexpr std::uint32_t kMagic = 0x07230203;
constexpr std::uint32_t kUnset = ~0u;

/// What instructions declare about an id.
struct Id {
    std::uint32_t opcode = 0;
    std::span<const std::uint32_t> words; ///< the declaring instruction, including its opcode word
    std::uint32_t spec_id = kUnset, binding = kUnset, set = 0, array_stride = 0;
    bool buffer_block = false;
    std::vector<std::uint32_t> member_offsets;
};

[[noreturn]] void fail(const std::string& reason) { throw std::logic_error("SPIR-V: " + reason); }

void decorate(Id& id, std::span<const std::uint32_t> words) {
    const std::uint32_t value = words.size() > 3 ? words[3] : 0;
    switch (words[2]) {
    case kSpecId:
        id.spec_id = value;
        break;
    case kBufferBlock:
        id.buffer_block = true;
        break;
    case kArrayStride:
        id.array_stride = value;
        break;
    case kBinding:
        id.binding = value;
        break;
    case kDescriptorSet:
        id.set = value;
        break;
    }
}

void decorateMember(Id& id, std::span<const std::uint32_t> words) {
    if (words[3] != kMemberOffset) return;
    if (id.member_offsets.size() <= words[2]) id.member_offsets.resize(words[2] + 1);
    id.member_offsets[words[2]] = words[4];
}

/// The position of the word with the id that an instruction declares; 0 for instructions that are not needed here.
std::size_t resultWord(std::uint32_t opcode) {
    switch (opcode) {
    case kOpTypeInt:
    case kOpTypeFloat:
    case kOpTypeVector:
    case kOpTypeImage:
    case kOpTypeSampledImage:
    case kOpTypeArray:
    case kOpTypeStruct:
    case kOpTypePointer:
    case kOpTypeAccelerationStructure:
        return 1;
    case kOpConstant:
    case kOpVariable:
        return 2;
    default:
        return 0;
    }
}

std::vector<Id> readIds(std::span<const std::uint32_t> spirv) {
    if (spirv.size() < kHeaderWords || spirv[0] != kMagic) fail("not a module");
    std::vector<Id> ids(spirv[3]);
    for (std::size_t at = kHeaderWords; at < spirv.size();) {
        const std::uint32_t opcode = spirv[at] & 0xFFFFu, count = spirv[at] >> 16;
        if (count == 0 || count > spirv.size() - at) fail("truncated instruction");
        const auto words = spirv.subspan(at, count);
        if (opcode == kOpDecorate) decorate(ids.at(words[1]), words);
        if (opcode == kOpMemberDecorate) decorateMember(ids.at(words[1]), words);
        if (const std::size_t place = resultWord(opcode)) {
            Id& id = ids.at(words[place]);
            id.opcode = opcode;
            id.words = words;
        }
        at += count;
    }
    return ids;
}

std::uint32_t typeBytes(const std::vector<Id>& ids, std::uint32_t type) {
    const Id& id = ids.at(type);
    switch (id.opcode) {
    case kOpTypeInt:
    case kOpTypeFloat:
        return id.words[2] / 8;
    case kOpTypeVector:
        return typeBytes(ids, id.words[2]) * id.words[3];
    case kOpTypeArray:
        return id.array_stride * ids.at(id.words[3]).words[3];
    case kOpTypeStruct: {
        std::uint32_t end = 0;
        for (std::size_t member = 0; member + 2 < id.words.size(); ++member)
            end = std::max(end, id.member_offsets.at(member) + typeBytes(ids, id.words[member + 2]));
        return end;
    }
    default:
        fail("push constants have a type without a known size");
    }
}

VkDescriptorType descriptorType(const std::vector<Id>& ids, const Id& variable, const Id& pointee) {
    const std::uint32_t storage_class = variable.words[3];
    if (storage_class == kStorageBuffer || pointee.buffer_block) return VK_DESCRIPTOR_TYPE_STORAGE_BUFFER;
    if (storage_class == kUniform && pointee.opcode == kOpTypeStruct) return VK_DESCRIPTOR_TYPE_UNIFORM_BUFFER;
    if (pointee.opcode == kOpTypeAccelerationStructure) return VK_DESCRIPTOR_TYPE_ACCELERATION_STRUCTURE_KHR;
    const Id& image = pointee.opcode == kOpTypeSampledImage ? ids.at(pointee.words[2]) : pointee;
    if (image.opcode == kOpTypeImage && image.words[3] == kDimBuffer)
        return image.words[7] == kImageSampled ? VK_DESCRIPTOR_TYPE_UNIFORM_TEXEL_BUFFER
                                               : VK_DESCRIPTOR_TYPE_STORAGE_TEXEL_BUFFER;
    fail("binding " + std::to_string(variable.binding) + " is not a buffer or an acceleration structure");
}

ShaderBinding bindingOf(const std::vector<Id>& ids, const Id& variable) {
    if (variable.set > 1) fail("only descriptor sets 0 and 1 are used");
    const Id* pointee = &ids.at(ids.at(variable.words[1]).words[3]);
    std::uint32_t count = 1;
    if (pointee->opcode == kOpTypeArray) {
        count = ids.at(pointee->words[3]).words[3];
        pointee = &ids.at(pointee->words[2]);
    }
    return {gpu::Binding{variable.binding}, descriptorType(ids, variable, *pointee), variable.set, count};
}

} // namespace

ShaderInterface reflectShader(std::span<const std::uint32_t> spirv) {
    const auto place = [](const ShaderBinding& binding) { return std::pair(binding.set, binding.slot); };
    const std::vector<Id> ids = readIds(spirv);
    ShaderInterface shader;
    for (const Id& id : ids) {
        if (id.spec_id != kUnset) shader.constants.push_back(gpu::SpecId{id.spec_id});
        if (id.opcode != kOpVariable) continue;
        const std::uint32_t storage_class = id.words[3];
        if (storage_class == kPushConstant) shader.push_bytes = typeBytes(ids, ids.at(id.words[1]).words[3]);
        if (id.binding == kUnset) continue;
        shader.bindings.push_back(bindingOf(ids, id));
    }
    std::sort(shader.constants.begin(), shader.constants.end());
    std::sort(shader.bindings.begin(), shader.bindings.end(),
              [&](const ShaderBinding& a, const ShaderBinding& b) { return place(a) < place(b); });
    for (std::size_t i = 1; i < shader.bindings.size(); ++i)
        if (place(shader.bindings[i]) == place(shader.bindings[i - 1])) fail("two variables share a binding");
    return shader;
}

} // namespace pointrt

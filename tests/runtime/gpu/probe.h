// SPDX-License-Identifier: Apache-2.0
// Runs a program that evaluates shader functions, on the available Vulkan device.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <initializer_list>
#include <span>
#include <vector>

#include "runtime/gpu/device.h"
#include "runtime/gpu/program.h"
#include "runtime/gpu/resources.h"
#include "tests/support/validated_device.h"

namespace pointrt {

/// Buffers at bindings 0, 1, 2, ... as probes declare them.
inline std::vector<BufferBinding> bindingsInOrder(std::initializer_list<const Buffer*> buffers) {
    std::vector<BufferBinding> bindings;
    for (const Buffer* buffer : buffers)
        bindings.push_back({gpu::Binding{static_cast<std::uint32_t>(bindings.size())}, buffer});
    return bindings;
}

/// Runs the program once, for count results by workgroups of 64, with buffers at bindings 0, 1, ...; the last one
/// receives the results. Destroys the buffers.
template <typename Answer>
std::vector<Answer> answersOf(Device& device, std::span<const std::uint32_t> spirv, std::vector<Buffer> buffers,
                              std::size_t count, std::span<const std::byte> push) {
    std::vector<Answer> answers(count);
    const std::uint64_t bytes = answers.size() * sizeof(Answer);
    buffers.push_back(createBuffer(device, "answers", bytes, VK_BUFFER_USAGE_STORAGE_BUFFER_BIT));
    Program program = createProgram(device, "probe", spirv);
    VkDescriptorPool pool = createDescriptorPool(device, 1);
    std::vector<BufferBinding> bindings;
    for (const Buffer& buffer : buffers)
        bindings.push_back({gpu::Binding{static_cast<std::uint32_t>(bindings.size())}, &buffer});
    const VkDescriptorSet set = createDescriptorSet(device, pool, program, bindings);
    const VkCommandBuffer commands = beginCommands(device);
    recordDispatch(commands, program, set, push, {static_cast<std::uint32_t>((count + 63) / 64), 1, 1});
    submitAndWait(device, commands);
    downloadBuffer(device, buffers.back(), answers.data(), bytes);
    destroyDescriptorPool(device, pool);
    destroyProgram(device, program);
    for (Buffer& buffer : buffers) destroyBuffer(device, buffer);
    return answers;
}

template <typename Row>
Buffer filledBuffer(Device& device, const std::vector<Row>& rows) {
    return createFilledBuffer(device, "rows", rows.data(), rows.size() * sizeof(Row),
                              VK_BUFFER_USAGE_STORAGE_BUFFER_BIT);
}

/// A program with storage buffers at bindings 0 and 1 for input and at 2 for output, a local size of 64 and a push
/// block of four counts, of which the first is the number of results. Validation messages fail the test.
template <typename Answer, typename First, typename Second>
std::vector<Answer> runProbe(std::span<const std::uint32_t> spirv, const std::vector<First>& first,
                             const std::vector<Second>& second, std::array<std::uint32_t, 4> counts) {
    ValidatedDevice validated;
    Device& device = validated.device;
    return answersOf<Answer>(device, spirv, {filledBuffer(device, first), filledBuffer(device, second)}, counts[0],
                             pushBytes(counts));
}

} // namespace pointrt

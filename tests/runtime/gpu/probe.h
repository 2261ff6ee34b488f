// SPDX-License-Identifier: Apache-2.0
// Runs a program that answers questions about shader functions, on whatever Vulkan device there is.
#pragma once

#include <gtest/gtest.h>

#include <array>
#include <cstdint>
#include <cstdlib>
#include <initializer_list>
#include <span>
#include <vector>

#include "runtime/gpu/device.h"
#include "runtime/gpu/program.h"
#include "runtime/gpu/resources.h"

namespace pointrt {

/// Buffers at bindings 0, 1, 2, ..., as probes have them.
inline std::vector<BufferBinding> bindingsInOrder(std::initializer_list<const Buffer*> buffers) {
    std::vector<BufferBinding> bindings;
    for (const Buffer* buffer : buffers)
        bindings.push_back({gpu::Binding{static_cast<std::uint32_t>(bindings.size())}, buffer});
    return bindings;
}

/// A program with storage buffers at bindings 0 and 1 to read and at 2 to write, a local size of 64 and a push block of
/// four counts, the first of them the answers'. Validation messages fail the test.
template <typename Answer, typename First, typename Second>
std::vector<Answer> runProbe(std::span<const std::uint32_t> spirv, const std::vector<First>& first,
                             const std::vector<Second>& second, std::array<std::uint32_t, 4> counts) {
    constexpr VkBufferUsageFlags kStorage = VK_BUFFER_USAGE_STORAGE_BUFFER_BIT;
    setenv("POINTRT_VALIDATION", "1", 1);
    const std::uint64_t messages_before = validationMessages();
    Device device = createDevice({});
    std::vector<Answer> answers(counts[0]);
    const std::uint64_t bytes = answers.size() * sizeof(Answer);
    Buffer buffers[] = {createFilledBuffer(device, "first", first.data(), first.size() * sizeof(First), kStorage),
                        createFilledBuffer(device, "second", second.data(), second.size() * sizeof(Second), kStorage),
                        createBuffer(device, "answers", bytes, kStorage)};
    Program program = createProgram(device, "probe", spirv);
    VkDescriptorPool pool = createDescriptorPool(device, 1);
    const VkDescriptorSet set =
        createDescriptorSet(device, pool, program, bindingsInOrder({&buffers[0], &buffers[1], &buffers[2]}));
    const VkCommandBuffer commands = beginCommands(device);
    recordDispatch(commands, program, set, pushBytes(counts), {(counts[0] + 63) / 64, 1, 1});
    submitAndWait(device, commands);
    downloadBuffer(device, buffers[2], answers.data(), bytes);
    destroyDescriptorPool(device, pool);
    destroyProgram(device, program);
    for (Buffer& buffer : buffers) destroyBuffer(device, buffer);
    destroyDevice(device);
    EXPECT_EQ(validationMessages(), messages_before);
    return answers;
}

} // namespace pointrt

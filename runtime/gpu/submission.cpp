// SPDX-License-Identifier: Apache-2.0
// Command buffers and their submission, in an order that the timeline numbers.
#include "runtime/gpu/device.h"

namespace pointrt {
namespace {

VkCommandBuffer newCommands(Device& device) {
    VkCommandBufferAllocateInfo allocate{VK_STRUCTURE_TYPE_COMMAND_BUFFER_ALLOCATE_INFO};
    allocate.commandPool = device.command_pool;
    allocate.level = VK_COMMAND_BUFFER_LEVEL_PRIMARY;
    allocate.commandBufferCount = 1;
    VkCommandBuffer commands = VK_NULL_HANDLE;
    check(vkAllocateCommandBuffers(device.handle, &allocate, &commands), "allocate a command buffer");
    return commands;
}

/// A command buffer whose commands are done, or a new one.
VkCommandBuffer takeCommands(Device& device) {
    if (device.in_flight.empty() || !isDone(device, device.in_flight.front().number)) return newCommands(device);
    const VkCommandBuffer commands = device.in_flight.front().commands;
    device.in_flight.erase(device.in_flight.begin());
    return commands;
}

/// Makes all writes visible to the host and to later commands, which wait for these.
void recordEnd(VkCommandBuffer commands) {
    VkMemoryBarrier barrier{VK_STRUCTURE_TYPE_MEMORY_BARRIER};
    barrier.srcAccessMask = VK_ACCESS_MEMORY_WRITE_BIT;
    barrier.dstAccessMask = VK_ACCESS_HOST_READ_BIT | VK_ACCESS_MEMORY_READ_BIT | VK_ACCESS_MEMORY_WRITE_BIT;
    vkCmdPipelineBarrier(commands, VK_PIPELINE_STAGE_ALL_COMMANDS_BIT,
                         VK_PIPELINE_STAGE_HOST_BIT | VK_PIPELINE_STAGE_ALL_COMMANDS_BIT, 0, 1, &barrier, 0, nullptr, 0,
                         nullptr);
}

} // namespace

std::unique_lock<std::mutex> lockQueue(Device& device) { return std::unique_lock(*device.queue_mutex); }

VkCommandBuffer beginCommands(Device& device, const char* name) {
    const VkCommandBuffer commands = takeCommands(device);
    nameObject(device, VK_OBJECT_TYPE_COMMAND_BUFFER, commands, name);
    VkCommandBufferBeginInfo begin{VK_STRUCTURE_TYPE_COMMAND_BUFFER_BEGIN_INFO};
    begin.flags = VK_COMMAND_BUFFER_USAGE_ONE_TIME_SUBMIT_BIT;
    check(vkBeginCommandBuffer(commands, &begin), "begin a command buffer");
    return commands;
}

std::uint64_t submit(Device& device, VkCommandBuffer commands) {
    recordEnd(commands);
    check(vkEndCommandBuffer(commands), "record commands");
    VkTimelineSemaphoreSubmitInfo numbers{VK_STRUCTURE_TYPE_TIMELINE_SEMAPHORE_SUBMIT_INFO};
    VkSubmitInfo info{VK_STRUCTURE_TYPE_SUBMIT_INFO, &numbers};
    info.commandBufferCount = 1;
    info.pCommandBuffers = &commands;
    info.signalSemaphoreCount = numbers.signalSemaphoreValueCount = 1;
    info.pSignalSemaphores = &device.timeline->semaphore;
    const auto lock = lockQueue(device);
    const std::uint64_t number = device.timeline->submitted + 1;
    numbers.pSignalSemaphoreValues = &number;
    check(vkQueueSubmit(device.queue, 1, &info, VK_NULL_HANDLE), "submit work to the device");
    device.timeline->submitted = number;
    device.in_flight.push_back({commands, number});
    return number;
}

bool isDone(const Device& device, std::uint64_t submission) {
    std::uint64_t done = 0;
    check(vkGetSemaphoreCounterValue(device.handle, device.timeline->semaphore, &done), "ask the device's progress");
    return done >= submission;
}

void waitFor(const Device& device, std::uint64_t submission) {
    if (submission == 0) return;
    VkSemaphoreWaitInfo info{VK_STRUCTURE_TYPE_SEMAPHORE_WAIT_INFO};
    info.semaphoreCount = 1;
    info.pSemaphores = &device.timeline->semaphore;
    info.pValues = &submission;
    check(vkWaitSemaphores(device.handle, &info, UINT64_MAX), "wait for the device");
}

void submitAndWait(Device& device, VkCommandBuffer commands) { waitFor(device, submit(device, commands)); }

} // namespace pointrt

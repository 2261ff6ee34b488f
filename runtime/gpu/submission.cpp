// SPDX-License-Identifier: Apache-2.0
// Command buffers and their submissions, which the timeline numbers in order.
#include <utility>

#include "format/base/error.h"
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

/// Makes all writes visible to the host and to later commands, which wait for them.
void recordEnd(VkCommandBuffer commands) {
    VkMemoryBarrier barrier{VK_STRUCTURE_TYPE_MEMORY_BARRIER};
    barrier.srcAccessMask = VK_ACCESS_MEMORY_WRITE_BIT;
    barrier.dstAccessMask = VK_ACCESS_HOST_READ_BIT | VK_ACCESS_MEMORY_READ_BIT | VK_ACCESS_MEMORY_WRITE_BIT;
    vkCmdPipelineBarrier(commands, VK_PIPELINE_STAGE_ALL_COMMANDS_BIT,
                         VK_PIPELINE_STAGE_HOST_BIT | VK_PIPELINE_STAGE_ALL_COMMANDS_BIT, 0, 1, &barrier, 0, nullptr, 0,
                         nullptr);
}

void end(VkCommandBuffer commands) {
    recordEnd(commands);
    check(vkEndCommandBuffer(commands), "record commands");
}

/// Submits the held commands. The caller has locked the queue.
void submitHeld(const Device& device, const std::optional<DisplaySync>& display) {
    Timeline& timeline = *device.timeline;
    const std::vector<VkCommandBuffer> commands = std::exchange(timeline.held, {});
    const VkSemaphore signalled[] = {timeline.semaphore, display ? display->drawn : VK_NULL_HANDLE};
    const VkPipelineStageFlags first_use = VK_PIPELINE_STAGE_TRANSFER_BIT; // where the display's image is first used
    VkTimelineSemaphoreSubmitInfo numbers{VK_STRUCTURE_TYPE_TIMELINE_SEMAPHORE_SUBMIT_INFO};
    VkSubmitInfo info{VK_STRUCTURE_TYPE_SUBMIT_INFO, &numbers};
    info.commandBufferCount = static_cast<std::uint32_t>(commands.size());
    info.pCommandBuffers = commands.data();
    info.signalSemaphoreCount = numbers.signalSemaphoreValueCount = display ? 2 : 1;
    info.pSignalSemaphores = signalled;
    info.waitSemaphoreCount = numbers.waitSemaphoreValueCount = display ? 1 : 0;
    info.pWaitSemaphores = display ? &display->acquired : nullptr;
    info.pWaitDstStageMask = &first_use;
    const std::uint64_t number = timeline.submitted + 1;
    const std::uint64_t values[] = {number, 0}, no_value = 0; // the semaphores of the display have no values
    numbers.pSignalSemaphoreValues = values;
    numbers.pWaitSemaphoreValues = &no_value;
    check(vkQueueSubmit(device.queue, 1, &info, VK_NULL_HANDLE), "submit work to the device");
    timeline.submitted = number;
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

std::uint64_t submit(Device& device, VkCommandBuffer commands, const std::optional<DisplaySync>& display) {
    end(commands);
    const auto lock = lockQueue(device);
    device.timeline->held.push_back(commands);
    submitHeld(device, display);
    device.in_flight.push_back({commands, device.timeline->submitted});
    return device.timeline->submitted;
}

std::uint64_t submitWithNext(Device& device, VkCommandBuffer commands) {
    end(commands);
    const auto lock = lockQueue(device);
    device.timeline->held.push_back(commands);
    device.in_flight.push_back({commands, device.timeline->submitted + 1});
    return device.in_flight.back().number;
}

bool isDone(const Device& device, std::uint64_t submission) {
    std::uint64_t done = 0;
    check(vkGetSemaphoreCounterValue(device.handle, device.timeline->semaphore, &done), "query the device's progress");
    return done >= submission;
}

void waitFor(const Device& device, std::uint64_t submission) {
    if (submission == 0 || isDone(device, submission)) return;
    {
        const std::scoped_lock lock(*device.queue_mutex);
        if (submission > device.timeline->submitted) submitHeld(device, {});
    }
    VkSemaphoreWaitInfo info{VK_STRUCTURE_TYPE_SEMAPHORE_WAIT_INFO};
    info.semaphoreCount = 1;
    info.pSemaphores = &device.timeline->semaphore;
    info.pValues = &submission;
    check(vkWaitSemaphores(device.handle, &info, UINT64_MAX), "wait for the device");
}

void waitForSubmitted(const Device& device) {
    if (!device.in_flight.empty()) waitFor(device, device.in_flight.back().number);
}

void finishSubmitted(const Device& device) noexcept {
    try {
        waitForSubmitted(device);
    } catch (const Error&) { // the device is lost
    }
}

void submitAndWait(Device& device, VkCommandBuffer commands) { waitFor(device, submit(device, commands)); }

} // namespace pointrt

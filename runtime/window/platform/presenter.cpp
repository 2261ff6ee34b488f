// SPDX-License-Identifier: Apache-2.0
#include "runtime/window/platform/presenter.h"

#include <optional>
#include <utility>

#include "runtime/gpu/program.h"
#include "runtime/util/on_error.h"
#include "runtime/window/platform/frame_commands.h"

namespace pointrt {
namespace {

void destroyFramebuffers(Device& device, Presenter& presenter) {
    for (VkFramebuffer framebuffer : presenter.framebuffers) vkDestroyFramebuffer(device.handle, framebuffer, nullptr);
    presenter.framebuffers.clear();
}

void destroyCanvas(Device& device, Presenter& presenter) {
    if (presenter.framebuffer) vkDestroyFramebuffer(device.handle, presenter.framebuffer, nullptr);
    presenter.framebuffer = VK_NULL_HANDLE;
    destroyImage(device, presenter.frame);
    destroyImage(device, presenter.low_res);
    destroyBuffer(device, presenter.host_upscaled);
    destroyImage(device, presenter.canvas);
}

/// Swapchain images and the offscreen frame share a format, because they share the UI's pipeline.
VkFormat frameFormat(const Presenter& presenter) {
    return presenter.surface ? presenter.swapchain.format : kCanvasFormat;
}

void createFrameObjects(Device& device, Presenter& presenter) {
    VkCommandBufferAllocateInfo allocate{VK_STRUCTURE_TYPE_COMMAND_BUFFER_ALLOCATE_INFO};
    allocate.commandPool = device.command_pool;
    allocate.level = VK_COMMAND_BUFFER_LEVEL_PRIMARY;
    allocate.commandBufferCount = 1;
    check(vkAllocateCommandBuffers(device.handle, &allocate, &presenter.commands), "allocate a command buffer");
    const VkFenceCreateInfo fence{VK_STRUCTURE_TYPE_FENCE_CREATE_INFO};
    check(vkCreateFence(device.handle, &fence, nullptr, &presenter.done), "create a fence");
}

/// Creates everything that depends on the window's size. The new canvas shows old scaled, or black without old.
void createCanvas(Device& device, Presenter& presenter, VkExtent2D extent, const Image* old) {
    presenter.canvas = createImage(device, "canvas", kCanvasFormat, extent, 0);
    // one more pixel each way, for interpolation at the edge
    presenter.low_res = createImage(device, "preview image", kCanvasFormat, {extent.width + 1, extent.height + 1}, 0);
    presenter.frame = createImage(device, "frame", frameFormat(presenter), extent, VK_IMAGE_USAGE_COLOR_ATTACHMENT_BIT);
    presenter.framebuffer = createUiFramebuffer(device, presenter.ui, presenter.frame.view, extent);
    const VkCommandBuffer commands = beginCommands(device);
    recordImageBarrier(commands, presenter.canvas.handle, discarded(kTransferDst), kTransferDst);
    if (old)
        recordBlit(commands, *old, old->extent, presenter.canvas.handle, extent);
    else
        recordBlack(commands, presenter.canvas);
    recordImageBarrier(commands, presenter.canvas.handle, kTransferDst, kTransferSrc);
    submitAndWait(device, commands);
}

void waitForFrame(Device& device, Presenter& presenter) {
    if (!presenter.in_flight) return;
    check(vkWaitForFences(device.handle, 1, &presenter.done, VK_TRUE, UINT64_MAX), "wait for a frame");
    check(vkResetFences(device.handle, 1, &presenter.done), "reset a fence");
    presenter.in_flight = false;
}

void beginFrame(Presenter& presenter) {
    check(vkResetCommandBuffer(presenter.commands, 0), "reset a command buffer");
    VkCommandBufferBeginInfo begin{VK_STRUCTURE_TYPE_COMMAND_BUFFER_BEGIN_INFO};
    begin.flags = VK_COMMAND_BUFFER_USAGE_ONE_TIME_SUBMIT_BIT;
    check(vkBeginCommandBuffer(presenter.commands, &begin), "begin a command buffer");
}

void recordFrame(Device& device, Presenter& presenter, VkCommandBuffer commands, const FrameTarget& target,
                 const ImDrawData* ui) {
    recordCanvas(commands, presenter.canvas, target);
    ImageUse last = kTransferDst;
    if (ui) {
        recordImageBarrier(commands, target.image, kTransferDst, kColorAttachment);
        recordUi(device, presenter.ui, commands, target.framebuffer, target.extent, *ui);
        last = kColorAttachment;
    }
    recordImageBarrier(commands, target.image, last, target.end);
}

/// Submits the frame, synchronised with a swapchain image if there is one.
void submitFrame(Device& device, Presenter& presenter, const std::uint32_t* image) {
    check(vkEndCommandBuffer(presenter.commands), "record a frame");
    const VkPipelineStageFlags first_use = VK_PIPELINE_STAGE_TRANSFER_BIT;
    VkSubmitInfo submit{VK_STRUCTURE_TYPE_SUBMIT_INFO};
    submit.commandBufferCount = 1;
    submit.pCommandBuffers = &presenter.commands;
    if (image) {
        submit.waitSemaphoreCount = submit.signalSemaphoreCount = 1;
        submit.pWaitSemaphores = &presenter.swapchain.acquired;
        submit.pWaitDstStageMask = &first_use;
        submit.pSignalSemaphores = &presenter.swapchain.drawn[*image];
    }
    const auto lock = lockQueue(device);
    check(vkQueueSubmit(device.queue, 1, &submit, presenter.done), "submit a frame");
    presenter.in_flight = true;
}

void rebuild(Device& device, Presenter& presenter) {
    destroyFramebuffers(device, presenter);
    rebuildSwapchain(device, presenter.swapchain, presenter.canvas.extent);
    for (VkImageView view : presenter.swapchain.views)
        presenter.framebuffers.push_back(createUiFramebuffer(device, presenter.ui, view, presenter.swapchain.extent));
    presenter.outdated = false;
}

/// The next swapchain image, rebuilding if needed; none if the window shows nothing.
std::optional<std::uint32_t> nextImage(Device& device, Presenter& presenter) {
    // again if the window's size changes between the two calls
    for (int attempt = 0; attempt < 2; ++attempt) {
        if (presenter.outdated || !presenter.swapchain.handle) rebuild(device, presenter);
        if (!presenter.swapchain.handle) return {};
        const auto image = acquireImage(device, presenter.swapchain, presenter.outdated);
        if (image || !presenter.outdated) return image;
    }
    return {};
}

bool presentHeadless(Device& device, Presenter& presenter, const ImDrawData* ui) {
    beginFrame(presenter);
    recordFrame(device, presenter, presenter.commands, frameTarget(presenter.frame, presenter.framebuffer), ui);
    submitFrame(device, presenter, nullptr);
    return true;
}

} // namespace

Presenter createPresenter(Device& device, VkSurfaceKHR surface, std::uint32_t width, std::uint32_t height) {
    Presenter presenter;
    presenter.surface = surface;
    const OnError undo([&] { destroyPresenter(device, presenter); });
    if (surface) presenter.swapchain = createSwapchain(device, surface);
    presenter.ui = createUiRenderer(device, frameFormat(presenter));
    createFrameObjects(device, presenter);
    createCanvas(device, presenter, {width, height}, nullptr);
    return presenter;
}

void destroyPresenter(Device& device, Presenter& presenter) {
    {
        const auto lock = lockQueue(device);
        vkQueueWaitIdle(device.queue);
    }
    destroyFramebuffers(device, presenter);
    destroyCanvas(device, presenter);
    if (presenter.commands) vkFreeCommandBuffers(device.handle, device.command_pool, 1, &presenter.commands);
    if (presenter.done) vkDestroyFence(device.handle, presenter.done, nullptr);
    destroyUiRenderer(device, presenter.ui);
    if (presenter.surface) {
        destroySwapchain(device, presenter.swapchain);
        vkDestroySurfaceKHR(device.instance, presenter.surface, nullptr);
    }
    presenter = {};
}

void resizeCanvas(Device& device, Presenter& presenter, std::uint32_t width, std::uint32_t height) {
    if (width == 0 || height == 0) return;
    waitForFrame(device, presenter);
    presenter.outdated = true;
    if (presenter.canvas.extent.width == width && presenter.canvas.extent.height == height) return;
    Image old = std::exchange(presenter.canvas, {});
    destroyCanvas(device, presenter);
    try {
        createCanvas(device, presenter, {width, height}, &old);
    } catch (...) {
        destroyImage(device, old);
        throw;
    }
    destroyImage(device, old);
}

bool present(Device& device, Presenter& presenter, const ImDrawData* ui) {
    waitForFrame(device, presenter);
    if (!presenter.surface) return presentHeadless(device, presenter, ui);
    const std::optional<std::uint32_t> image = nextImage(device, presenter);
    if (!image) return false;
    beginFrame(presenter);
    const FrameTarget target{presenter.swapchain.images[*image], presenter.swapchain.format,
                             presenter.framebuffers[*image], presenter.swapchain.extent, kPresentSrc};
    recordFrame(device, presenter, presenter.commands, target, ui);
    submitFrame(device, presenter, &*image);
    if (!presentImage(device, presenter.swapchain, *image)) presenter.outdated = true;
    return true;
}

void setUiFont(Device& device, Presenter& presenter) {
    waitForFrame(device, presenter);
    uploadUiFont(device, presenter.ui);
}

Image8 readCanvas(Device& device, Presenter& presenter) {
    const VkCommandBuffer commands = beginCommands(device);
    return readImage(device, commands, presenter.canvas);
}

Image8 readFrame(Device& device, Presenter& presenter, const ImDrawData* ui) {
    waitForFrame(device, presenter);
    const VkCommandBuffer commands = beginCommands(device);
    recordFrame(device, presenter, commands, frameTarget(presenter.frame, presenter.framebuffer), ui);
    return readImage(device, commands, presenter.frame);
}

} // namespace pointrt

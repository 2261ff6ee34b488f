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
    destroyImage(device, presenter.target);
    destroyImage(device, presenter.low_res);
    destroyBuffer(device, presenter.host_upscaled);
    destroyImage(device, presenter.canvas);
}

/// Swapchain images and the offscreen frame share a format, because they share the UI's pipeline.
VkFormat frameFormat(const Presenter& presenter) {
    return presenter.surface ? presenter.swapchain.format : kCanvasFormat;
}

/// Creates everything that depends on the window's size. The new canvas shows old scaled, or black without old.
void createCanvas(Device& device, Presenter& presenter, VkExtent2D extent, const Image* old) {
    presenter.canvas = createImage(device, "canvas", kCanvasFormat, extent, 0);
    // an extra row and column, for interpolation at the edge
    presenter.low_res = createImage(device, "preview image", kCanvasFormat, {extent.width + 1, extent.height + 1}, 0);
    presenter.target =
        createImage(device, "frame", frameFormat(presenter), extent, VK_IMAGE_USAGE_COLOR_ATTACHMENT_BIT);
    presenter.framebuffer = createUiFramebuffer(device, presenter.ui, presenter.target.view, extent);
    const VkCommandBuffer commands = beginCommands(device);
    recordImageBarrier(commands, presenter.canvas.handle, discarded(kTransferDst), kTransferDst);
    if (old)
        recordBlit(commands, *old, old->extent, presenter.canvas.handle, extent);
    else
        recordBlack(commands, presenter.canvas);
    recordImageBarrier(commands, presenter.canvas.handle, kTransferDst, kTransferSrc);
    submitAndWait(device, commands);
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

/// Ends a frame whose commands are recorded.
void submitFrame(Device& device, Presenter& presenter, VkCommandBuffer commands,
                 const std::optional<DisplaySync>& display) {
    presenter.frames[presenter.frame] = submit(device, commands, display);
    presenter.frame = (presenter.frame + 1) % kFramesInFlight;
}

void rebuild(Device& device, Presenter& presenter) {
    destroyFramebuffers(device, presenter);
    rebuildSwapchain(device, presenter.swapchain, presenter.canvas.extent);
    for (VkImageView view : presenter.swapchain.views)
        presenter.framebuffers.push_back(createUiFramebuffer(device, presenter.ui, view, presenter.swapchain.extent));
    presenter.outdated = false;
}

/// The next image of the swapchain, which is rebuilt if needed; none if the window shows nothing.
std::optional<std::uint32_t> nextImage(Device& device, Presenter& presenter) {
    // tries again if the window's size changes between the two calls
    for (int attempt = 0; attempt < 2; ++attempt) {
        if (presenter.outdated || !presenter.swapchain.handle) rebuild(device, presenter);
        if (!presenter.swapchain.handle) return {};
        const VkSemaphore acquired = presenter.swapchain.acquired[presenter.frame];
        const auto image = acquireImage(device, presenter.swapchain, acquired, presenter.outdated);
        if (image || !presenter.outdated) return image;
    }
    return {};
}

/// The image of the display to draw to, or the frame without a window; none if nothing can be shown.
std::optional<FrameTarget> nextTarget(Device& device, Presenter& presenter, std::optional<std::uint32_t>& image) {
    if (!presenter.surface) return frameTarget(presenter.target, presenter.framebuffer);
    image = nextImage(device, presenter);
    if (!image) return {};
    return FrameTarget{presenter.swapchain.images[*image], presenter.swapchain.format, presenter.framebuffers[*image],
                       presenter.swapchain.extent, kPresentSrc};
}

} // namespace

Presenter createPresenter(Device& device, VkSurfaceKHR surface, std::uint32_t width, std::uint32_t height) {
    Presenter presenter;
    presenter.surface = surface;
    const OnError undo([&] { destroyPresenter(device, presenter); });
    if (surface) presenter.swapchain = createSwapchain(device, surface);
    presenter.ui = createUiRenderer(device, frameFormat(presenter));
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
    destroyUiRenderer(device, presenter.ui);
    if (presenter.surface) {
        destroySwapchain(device, presenter.swapchain);
        vkDestroySurfaceKHR(device.instance, presenter.surface, nullptr);
    }
    presenter = {};
}

void resizeCanvas(Device& device, Presenter& presenter, std::uint32_t width, std::uint32_t height) {
    if (width == 0 || height == 0) return;
    waitForSubmitted(device);
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

bool present(Device& device, Presenter& presenter, const ImDrawData* ui,
             const std::function<void(VkCommandBuffer)>& uploads) {
    waitFor(device, presenter.frames[presenter.frame]);
    std::optional<std::uint32_t> image;
    const std::optional<FrameTarget> target = nextTarget(device, presenter, image);
    if (!target && !uploads) return false;
    const VkCommandBuffer commands = beginCommands(device, "frame");
    if (uploads) uploads(commands);
    if (target) recordFrame(device, presenter, commands, *target, ui);
    std::optional<DisplaySync> display;
    if (image) display = {presenter.swapchain.acquired[presenter.frame], presenter.swapchain.drawn[*image]};
    submitFrame(device, presenter, commands, display);
    if (image && !presentImage(device, presenter.swapchain, *image)) presenter.outdated = true;
    return target.has_value();
}

void setUiFont(Device& device, Presenter& presenter) {
    waitForSubmitted(device);
    uploadUiFont(device, presenter.ui);
}

Image8 readCanvas(Device& device, Presenter& presenter) {
    const VkCommandBuffer commands = beginCommands(device);
    return readImage(device, commands, presenter.canvas);
}

Image8 readFrame(Device& device, Presenter& presenter, const ImDrawData* ui) {
    waitForSubmitted(device);
    const VkCommandBuffer commands = beginCommands(device);
    recordFrame(device, presenter, commands, frameTarget(presenter.target, presenter.framebuffer), ui);
    return readImage(device, commands, presenter.target);
}

} // namespace pointrt

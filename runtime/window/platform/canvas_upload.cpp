// SPDX-License-Identifier: Apache-2.0
#include <stdexcept>

#include "runtime/gpu/program.h"
#include "runtime/window/platform/frame_commands.h"
#include "runtime/window/platform/presenter.h"
#include "runtime/window/platform/upscale.h"

namespace pointrt {
namespace {

void requireUpscalable(VkExtent2D canvas, std::uint32_t width, std::uint32_t height) {
    if (width == 0 || height == 0 || width > canvas.width || height > canvas.height)
        throw std::logic_error("a picture to upscale is empty or larger than the canvas");
}

/// Scales pixels, which are host-visible, on the host and records the copy to the canvas.
void upscaleOnHost(Device& device, Presenter& presenter, VkCommandBuffer commands, const Buffer& pixels,
                   PixelGrid size) {
    const VkExtent2D canvas = presenter.canvas.extent;
    const std::uint64_t bytes = std::uint64_t(canvas.width) * canvas.height * 4;
    if (presenter.host_upscaled.bytes != bytes) {
        destroyBuffer(device, presenter.host_upscaled);
        presenter.host_upscaled = createBuffer(device, "upscaled picture", bytes, 0, MemoryHome::kUpload);
    }
    waitForSubmitted(device); // the last frame may still be reading the buffer
    upscale(static_cast<const std::uint32_t*>(pixels.mapped), size,
            static_cast<std::uint32_t*>(presenter.host_upscaled.mapped), {canvas.width, canvas.height});
    recordUploadRows(commands, presenter, presenter.host_upscaled, 0, canvas.height);
}

} // namespace

void recordUploadRows(VkCommandBuffer commands, const Presenter& presenter, const Buffer& pixels,
                      std::uint32_t first_row, std::uint32_t rows) {
    const VkExtent2D extent = presenter.canvas.extent;
    if (first_row > extent.height || rows > extent.height - first_row) throw std::logic_error("rows below the canvas");
    if (rows == 0) return;
    recordBarrier(commands);
    const VkOffset2D start{0, static_cast<std::int32_t>(first_row)};
    const VkBufferImageCopy region = rectangleCopy(start, extent.width, start, {extent.width, rows});
    recordImageBarrier(commands, presenter.canvas.handle, kTransferSrc, kTransferDst);
    vkCmdCopyBufferToImage(commands, pixels.handle, presenter.canvas.handle, kTransferDst.layout, 1, &region);
    recordImageBarrier(commands, presenter.canvas.handle, kTransferDst, kTransferSrc);
}

void recordUploadScaled(VkCommandBuffer commands, const Presenter& presenter, const Buffer& pixels, std::uint32_t width,
                        std::uint32_t height) {
    const VkExtent2D canvas = presenter.canvas.extent;
    requireUpscalable(canvas, width, height);
    // repeat the last column and row, because interpolation at the edge reads one pixel further
    const auto w = static_cast<std::int32_t>(width), h = static_cast<std::int32_t>(height);
    const VkBufferImageCopy regions[] = {
        rectangleCopy({}, width, {}, {width, height}), rectangleCopy({w - 1, 0}, width, {w, 0}, {1, height}),
        rectangleCopy({0, h - 1}, width, {0, h}, {width, 1}), rectangleCopy({w - 1, h - 1}, width, {w, h}, {1, 1})};
    recordBarrier(commands);
    recordImageBarrier(commands, presenter.low_res.handle, discarded(kTransferSrc), kTransferDst);
    vkCmdCopyBufferToImage(commands, pixels.handle, presenter.low_res.handle, kTransferDst.layout, 4, regions);
    recordImageBarrier(commands, presenter.low_res.handle, kTransferDst, kTransferSrc);
    recordImageBarrier(commands, presenter.canvas.handle, discarded(kTransferSrc), kTransferDst);
    recordBlit(commands, presenter.low_res, {width, height}, presenter.canvas.handle, canvas);
    recordImageBarrier(commands, presenter.canvas.handle, kTransferDst, kTransferSrc);
}

void recordUploadPreview(Device& device, VkCommandBuffer commands, Presenter& presenter, const Buffer& pixels,
                         std::uint32_t width, std::uint32_t height) {
    requireUpscalable(presenter.canvas.extent, width, height);
    if (device.type == VK_PHYSICAL_DEVICE_TYPE_CPU && pixels.mapped)
        upscaleOnHost(device, presenter, commands, pixels, {width, height});
    else
        recordUploadScaled(commands, presenter, pixels, width, height);
}

} // namespace pointrt

// SPDX-License-Identifier: Apache-2.0
#include "runtime/window/platform/frame_commands.h"

#include <cstddef>

#include "runtime/gpu/program.h"
#include "runtime/gpu/resources.h"

namespace pointrt {
namespace {

VkOffset3D cornerOf(VkExtent2D extent) {
    return {static_cast<std::int32_t>(extent.width), static_cast<std::int32_t>(extent.height), 1};
}

bool sameSize(VkExtent2D a, VkExtent2D b) { return a.width == b.width && a.height == b.height; }

Image8 rgbOf(const std::byte* pixels, VkFormat format, VkExtent2D extent) {
    Image8 image{extent.width, extent.height, 3, {}};
    const std::size_t red = format == VK_FORMAT_B8G8R8A8_UNORM ? 2 : 0;
    const auto* from = reinterpret_cast<const std::uint8_t*>(pixels);
    const std::size_t count = std::size_t(extent.width) * extent.height;
    image.pixels.resize(count * 3);
    for (std::size_t i = 0; i < count; ++i) {
        image.pixels[i * 3] = from[i * 4 + red];
        image.pixels[i * 3 + 1] = from[i * 4 + 1];
        image.pixels[i * 3 + 2] = from[i * 4 + 2 - red];
    }
    return image;
}

} // namespace

FrameTarget frameTarget(const Image& frame, VkFramebuffer framebuffer) {
    return {frame.handle, frame.format, framebuffer, frame.extent, kTransferSrc};
}

void recordBlack(VkCommandBuffer commands, const Image& image) {
    const VkClearColorValue black{{0, 0, 0, 1}};
    const VkImageSubresourceRange all{VK_IMAGE_ASPECT_COLOR_BIT, 0, 1, 0, 1};
    vkCmdClearColorImage(commands, image.handle, kTransferDst.layout, &black, 1, &all);
}

void recordBlit(VkCommandBuffer commands, const Image& from, VkExtent2D part, VkImage to, VkExtent2D to_extent) {
    VkImageBlit region{};
    region.srcSubresource = region.dstSubresource = kColorLayer;
    region.srcOffsets[1] = cornerOf(part);
    region.dstOffsets[1] = cornerOf(to_extent);
    vkCmdBlitImage(commands, from.handle, kTransferSrc.layout, to, kTransferDst.layout, 1, &region, VK_FILTER_LINEAR);
}

void recordCanvas(VkCommandBuffer commands, const Image& canvas, const FrameTarget& target) {
    recordBarrier(commands);
    // wait for the target's last use: as an attachment, or until the acquire semaphore, whose wait stage is transfer,
    // is signalled
    const ImageUse last{kColorAttachment.stages | kTransferDst.stages, kColorAttachment.access | kTransferDst.access,
                        kColorAttachment.layout};
    recordImageBarrier(commands, target.image, discarded(last), kTransferDst);
    if (target.format != canvas.format || !sameSize(target.extent, canvas.extent))
        return recordBlit(commands, canvas, canvas.extent, target.image, target.extent);
    VkImageCopy region{};
    region.srcSubresource = region.dstSubresource = kColorLayer;
    region.extent = {canvas.extent.width, canvas.extent.height, 1};
    vkCmdCopyImage(commands, canvas.handle, kTransferSrc.layout, target.image, kTransferDst.layout, 1, &region);
}

VkBufferImageCopy rectangleCopy(VkOffset2D from, std::uint32_t pitch, VkOffset2D to, VkExtent2D size) {
    constexpr std::uint64_t kPixelBytes = 4;
    VkBufferImageCopy region{};
    region.bufferOffset =
        (static_cast<std::uint64_t>(from.y) * pitch + static_cast<std::uint64_t>(from.x)) * kPixelBytes;
    region.bufferRowLength = pitch;
    region.imageSubresource = kColorLayer;
    region.imageOffset = {to.x, to.y, 0};
    region.imageExtent = {size.width, size.height, 1};
    return region;
}

Image8 readImage(Device& device, VkCommandBuffer commands, const Image& image) {
    const VkExtent2D extent = image.extent;
    Buffer pixels =
        createBuffer(device, "screenshot", std::uint64_t(extent.width) * extent.height * 4, 0, MemoryHome::kReadback);
    recordBarrier(commands);
    const VkBufferImageCopy region = rectangleCopy({}, extent.width, {}, extent);
    vkCmdCopyImageToBuffer(commands, image.handle, kTransferSrc.layout, pixels.handle, 1, &region);
    submitAndWait(device, commands);
    Image8 read = rgbOf(hostBytes(device, pixels), image.format, extent);
    destroyBuffer(device, pixels);
    return read;
}

} // namespace pointrt

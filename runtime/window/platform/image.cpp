// SPDX-License-Identifier: Apache-2.0
#include "runtime/window/platform/image.h"

#include <string>

#include "format/base/error.h"
#include "runtime/util/on_error.h"

namespace pointrt {
namespace {

constexpr VkImageUsageFlags kTransfer = VK_IMAGE_USAGE_TRANSFER_SRC_BIT | VK_IMAGE_USAGE_TRANSFER_DST_BIT;

/// A device-local type among the allowed ones (one bit each), else any allowed type.
std::uint32_t imageMemoryType(const Device& device, std::uint32_t allowed) {
    std::uint32_t any = 0;
    for (std::uint32_t i = device.memory.memoryTypeCount; i-- > 0;) {
        if (!(allowed >> i & 1u)) continue;
        if (device.memory.memoryTypes[i].propertyFlags & VK_MEMORY_PROPERTY_DEVICE_LOCAL_BIT) return i;
        any = i;
    }
    return any;
}

void createHandle(Device& device, Image& image, VkImageUsageFlags usage, const char* action) {
    VkImageCreateInfo info{VK_STRUCTURE_TYPE_IMAGE_CREATE_INFO};
    info.imageType = VK_IMAGE_TYPE_2D;
    info.format = image.format;
    info.extent = {image.extent.width, image.extent.height, 1};
    info.mipLevels = info.arrayLayers = 1;
    info.samples = VK_SAMPLE_COUNT_1_BIT;
    info.tiling = VK_IMAGE_TILING_OPTIMAL;
    info.usage = usage | kTransfer;
    check(vkCreateImage(device.handle, &info, nullptr, &image.handle), action);
}

void allocateMemory(Device& device, Image& image, const char* action) {
    VkMemoryRequirements requirements;
    vkGetImageMemoryRequirements(device.handle, image.handle, &requirements);
    VkMemoryAllocateInfo info{VK_STRUCTURE_TYPE_MEMORY_ALLOCATE_INFO};
    info.allocationSize = requirements.size;
    info.memoryTypeIndex = imageMemoryType(device, requirements.memoryTypeBits);
    check(vkAllocateMemory(device.handle, &info, nullptr, &image.memory), action);
    check(vkBindImageMemory(device.handle, image.handle, image.memory, 0), action);
}

std::string sizeText(VkExtent2D extent) { return std::to_string(extent.width) + "x" + std::to_string(extent.height); }

} // namespace

Image createImage(Device& device, const char* what, VkFormat format, VkExtent2D extent, VkImageUsageFlags usage,
                  VkComponentMapping swizzle) {
    const std::string action = std::string("create ") + what + " of " + sizeText(extent);
    const std::uint32_t limit = device.limits.maxImageDimension2D;
    if (extent.width > limit || extent.height > limit)
        throw Error{ExitCode::kCannotRun,
                    "cannot " + action + ": the device's largest image is " + sizeText({limit, limit})};
    Image image;
    image.format = format;
    image.extent = extent;
    const OnError undo([&] { destroyImage(device, image); });
    createHandle(device, image, usage, action.c_str());
    nameObject(device, VK_OBJECT_TYPE_IMAGE, image.handle, what);
    allocateMemory(device, image, action.c_str());
    // images used only for transfers need no view
    if (usage & ~kTransfer) image.view = createView(device, image.handle, format, swizzle);
    return image;
}

void destroyImage(Device& device, Image& image) {
    if (image.handle) finishSubmitted(device);
    if (image.view) vkDestroyImageView(device.handle, image.view, nullptr);
    if (image.handle) vkDestroyImage(device.handle, image.handle, nullptr);
    if (image.memory) vkFreeMemory(device.handle, image.memory, nullptr);
    image = {};
}

VkImageView createView(Device& device, VkImage image, VkFormat format, VkComponentMapping swizzle) {
    VkImageViewCreateInfo info{VK_STRUCTURE_TYPE_IMAGE_VIEW_CREATE_INFO};
    info.image = image;
    info.viewType = VK_IMAGE_VIEW_TYPE_2D;
    info.format = format;
    info.components = swizzle;
    info.subresourceRange = {VK_IMAGE_ASPECT_COLOR_BIT, 0, 1, 0, 1};
    VkImageView view = VK_NULL_HANDLE;
    check(vkCreateImageView(device.handle, &info, nullptr, &view), "create a view of an image");
    return view;
}

void recordImageBarrier(VkCommandBuffer commands, VkImage image, ImageUse from, ImageUse to) {
    VkImageMemoryBarrier barrier{VK_STRUCTURE_TYPE_IMAGE_MEMORY_BARRIER};
    barrier.srcAccessMask = from.access;
    barrier.dstAccessMask = to.access;
    barrier.oldLayout = from.layout;
    barrier.newLayout = to.layout;
    barrier.srcQueueFamilyIndex = barrier.dstQueueFamilyIndex = VK_QUEUE_FAMILY_IGNORED;
    barrier.image = image;
    barrier.subresourceRange = {VK_IMAGE_ASPECT_COLOR_BIT, 0, 1, 0, 1};
    vkCmdPipelineBarrier(commands, from.stages, to.stages, 0, 0, nullptr, 0, nullptr, 1, &barrier);
}

} // namespace pointrt

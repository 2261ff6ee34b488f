// SPDX-License-Identifier: Apache-2.0
#include "runtime/gpu/resources.h"

#include <algorithm>
#include <bit>
#include <cstring>
#include <stdexcept>
#include <string>

#include "format/base/error.h"
#include "runtime/gpu/staging.h"
#include "runtime/util/memory_text.h"
#include "runtime/util/on_error.h"

namespace pointrt {
namespace {

// Vulkan has no empty buffers, but sections may be empty. 16 bytes is the size of the largest texel.
constexpr std::uint64_t kMinBufferBytes = 16;
constexpr VkBufferUsageFlags kTransfer = VK_BUFFER_USAGE_TRANSFER_SRC_BIT | VK_BUFFER_USAGE_TRANSFER_DST_BIT;

void createHandle(Device& device, const char* what, Buffer& buffer, VkBufferUsageFlags usage) {
    VkBufferCreateInfo info{VK_STRUCTURE_TYPE_BUFFER_CREATE_INFO};
    info.size = std::max(buffer.bytes, kMinBufferBytes);
    info.usage = usage | kTransfer;
    info.sharingMode = VK_SHARING_MODE_EXCLUSIVE;
    check(vkCreateBuffer(device.handle, &info, nullptr, &buffer.handle), (std::string("create ") + what).c_str());
    nameObject(device, VK_OBJECT_TYPE_BUFFER, buffer.handle, what);
}

void allocateMemory(Device& device, const char* what, Buffer& buffer, MemoryHome home) {
    VkMemoryRequirements requirements;
    vkGetBufferMemoryRequirements(device.handle, buffer.handle, &requirements);
    const auto type = chooseMemoryType(device.memory, requirements.memoryTypeBits, home, device.unified_memory);
    if (!type) throw Error{ExitCode::kCannotRun, std::string("cannot allocate ") + what + ": no suitable memory type"};
    const VkMemoryPropertyFlags properties = device.memory.memoryTypes[*type].propertyFlags;
    const std::string action = std::string("allocate ") + what + " (" + mebibytes(buffer.bytes) + ")";
    buffer.range = device.memory_pool->allocate(device, requirements, *type,
                                                isMapped(properties, home, device.unified_memory), action.c_str());
    check(vkBindBufferMemory(device.handle, buffer.handle, buffer.range.memory, buffer.range.offset), action.c_str());
    buffer.mapped = buffer.range.mapped;
    buffer.coherent = (properties & VK_MEMORY_PROPERTY_HOST_COHERENT_BIT) != 0;
}

/// The memory types (a bit mask) as which host memory at data can be imported; 0: none.
std::uint32_t importableTypes(Device& device, const void* data) {
    VkMemoryHostPointerPropertiesEXT properties{VK_STRUCTURE_TYPE_MEMORY_HOST_POINTER_PROPERTIES_EXT};
    const VkResult result = device.getMemoryHostPointerProperties(
        device.handle, VK_EXTERNAL_MEMORY_HANDLE_TYPE_HOST_ALLOCATION_BIT_EXT, data, &properties);
    return result == VK_SUCCESS ? properties.memoryTypeBits : 0;
}

/// Binds the pages at data as the buffer's memory; false if the driver refuses.
bool importMemory(Device& device, const void* data, std::uint64_t bytes, Buffer& buffer) {
    VkMemoryRequirements requirements;
    vkGetBufferMemoryRequirements(device.handle, buffer.handle, &requirements);
    const std::uint32_t types = requirements.memoryTypeBits & importableTypes(device, data);
    if (types == 0 || requirements.size > bytes) return false;
    VkImportMemoryHostPointerInfoEXT import{VK_STRUCTURE_TYPE_IMPORT_MEMORY_HOST_POINTER_INFO_EXT};
    import.handleType = VK_EXTERNAL_MEMORY_HANDLE_TYPE_HOST_ALLOCATION_BIT_EXT;
    import.pHostPointer = const_cast<void*>(data);
    VkMemoryAllocateInfo info{VK_STRUCTURE_TYPE_MEMORY_ALLOCATE_INFO, &import};
    info.allocationSize = bytes;
    info.memoryTypeIndex = static_cast<std::uint32_t>(std::countr_zero(types));
    return vkAllocateMemory(device.handle, &info, nullptr, &buffer.range.memory) == VK_SUCCESS &&
           vkBindBufferMemory(device.handle, buffer.handle, buffer.range.memory, 0) == VK_SUCCESS;
}

void copyAndWait(Device& device, const Buffer& from, const Buffer& to, VkBufferCopy region) {
    const VkCommandBuffer commands = beginCommands(device, "buffer copy");
    vkCmdCopyBuffer(commands, from.handle, to.handle, 1, &region);
    submitAndWait(device, commands);
}

void requireInside(const Buffer& buffer, std::uint64_t bytes, std::uint64_t offset) {
    if (offset > buffer.bytes || bytes > buffer.bytes - offset) throw std::logic_error("copy outside of a buffer");
}

/// The whole range, since the offset and size of a part would have to be multiples of nonCoherentAtomSize.
VkMappedMemoryRange mappedRange(const Buffer& buffer) {
    VkMappedMemoryRange range{VK_STRUCTURE_TYPE_MAPPED_MEMORY_RANGE};
    range.memory = buffer.range.memory;
    range.offset = buffer.range.offset;
    range.size = buffer.range.bytes;
    return range;
}

/// Does not wait if the device is lost, since it runs nothing any more.
void waitForUpload(const Device& device, const Buffer& buffer) {
    if (buffer.uploaded == 0) return;
    try {
        waitFor(device, buffer.uploaded);
    } catch (const Error&) {
    }
}

void addView(Device& device, const char* what, Buffer& buffer, VkFormat format) {
    const std::uint64_t size = texelBytes(format);
    const std::uint64_t texels = std::max(buffer.bytes, kMinBufferBytes) / size;
    if (texels > device.limits.maxTexelBufferElements)
        throw Error{ExitCode::kCannotRun, std::string(what) + " has " + std::to_string(texels) +
                                              " texels, the limit of the device is " +
                                              std::to_string(device.limits.maxTexelBufferElements)};
    VkBufferViewCreateInfo info{VK_STRUCTURE_TYPE_BUFFER_VIEW_CREATE_INFO};
    info.buffer = buffer.handle;
    info.format = format;
    info.range = texels * size;
    check(vkCreateBufferView(device.handle, &info, nullptr, &buffer.view),
          (std::string("create a view of ") + what).c_str());
    if (buffer.imported)
        // placed memory had no name when the buffer was created
        nameObject(device, VK_OBJECT_TYPE_BUFFER, buffer.handle, what);
    nameObject(device, VK_OBJECT_TYPE_BUFFER_VIEW, buffer.view, what);
}

} // namespace

Buffer createBuffer(Device& device, const char* what, std::uint64_t bytes, VkBufferUsageFlags usage, MemoryHome home) {
    if (bytes > device.max_allocation_bytes) {
        const SizeAndLimit shown = sizeAndLimit(bytes, device.max_allocation_bytes, mebibytes);
        throw Error{ExitCode::kCannotRun, std::string("cannot allocate ") + what + ": " + shown.size +
                                              " exceeds the device's largest allocation, " + shown.limit};
    }
    Buffer buffer;
    buffer.bytes = bytes;
    const OnError undo([&] { destroyBuffer(device, buffer); });
    createHandle(device, what, buffer, usage);
    allocateMemory(device, what, buffer, home);
    return buffer;
}

void destroyBuffer(Device& device, Buffer& buffer) {
    if (buffer.handle) finishSubmitted(device);
    waitForUpload(device, buffer);
    if (buffer.tree) device.rays.destroyTree(device.handle, buffer.tree, nullptr);
    if (buffer.view) vkDestroyBufferView(device.handle, buffer.view, nullptr);
    if (buffer.handle) vkDestroyBuffer(device.handle, buffer.handle, nullptr);
    if (buffer.imported && buffer.range.memory)
        vkFreeMemory(device.handle, buffer.range.memory, nullptr);
    else if (buffer.range.memory && !buffer.placed)
        device.memory_pool->free(device, buffer.range);
    buffer = {};
}

Buffer createPlacedBuffer(Device& device, const char* what, std::uint64_t bytes, VkBufferUsageFlags usage,
                          const Buffer& in, std::uint64_t offset) {
    Buffer buffer;
    buffer.bytes = bytes;
    buffer.placed = true;
    const OnError undo([&] { destroyBuffer(device, buffer); });
    createHandle(device, what, buffer, usage);
    VkMemoryRequirements requirements;
    vkGetBufferMemoryRequirements(device.handle, buffer.handle, &requirements);
    buffer.range = in.range;
    buffer.range.offset += offset;
    const std::uint64_t atom = std::max<std::uint64_t>(device.limits.nonCoherentAtomSize, 1);
    buffer.range.bytes = (requirements.size + atom - 1) / atom * atom; // the size that flushBuffer needs
    if (buffer.range.offset % requirements.alignment != 0 || offset + buffer.range.bytes > in.range.bytes ||
        (requirements.memoryTypeBits >> in.range.type & 1) == 0)
        throw std::logic_error(std::string(what) + " does not fit where it was placed");
    check(vkBindBufferMemory(device.handle, buffer.handle, buffer.range.memory, buffer.range.offset),
          (std::string("place ") + what).c_str());
    buffer.mapped = in.mapped ? static_cast<std::byte*>(in.mapped) + offset : nullptr;
    buffer.coherent = in.coherent;
    return buffer;
}

Buffer createFilledBuffer(Device& device, const char* what, const void* data, std::uint64_t bytes,
                          VkBufferUsageFlags usage) {
    Buffer buffer = createBuffer(device, what, bytes, usage);
    const OnError undo([&] { destroyBuffer(device, buffer); });
    uploadBuffer(device, buffer, data, bytes);
    return buffer;
}

Buffer importHostBuffer(Device& device, const void* data, std::uint64_t bytes, VkBufferUsageFlags usage) {
    const std::uint64_t alignment = device.host_import_alignment;
    if (!device.external_memory_host || !alignment || bytes == 0) return {};
    if (reinterpret_cast<std::uintptr_t>(data) % alignment != 0) return {};
    const std::uint64_t whole_pages = (bytes + alignment - 1) / alignment * alignment;

    VkExternalMemoryBufferCreateInfo external{VK_STRUCTURE_TYPE_EXTERNAL_MEMORY_BUFFER_CREATE_INFO};
    external.handleTypes = VK_EXTERNAL_MEMORY_HANDLE_TYPE_HOST_ALLOCATION_BIT_EXT;
    VkBufferCreateInfo info{VK_STRUCTURE_TYPE_BUFFER_CREATE_INFO, &external};
    info.size = std::max(bytes, kMinBufferBytes);
    info.usage = usage | VK_BUFFER_USAGE_TRANSFER_SRC_BIT;
    info.sharingMode = VK_SHARING_MODE_EXCLUSIVE;
    Buffer buffer;
    buffer.bytes = bytes;
    buffer.imported = true;
    if (vkCreateBuffer(device.handle, &info, nullptr, &buffer.handle) != VK_SUCCESS ||
        !importMemory(device, data, whole_pages, buffer))
        destroyBuffer(device, buffer);
    return buffer;
}

std::uint64_t texelBytes(VkFormat format) {
    switch (format) {
    case VK_FORMAT_R32_UINT:
    case VK_FORMAT_R32_SFLOAT:
        return 4;
    case VK_FORMAT_R32G32_UINT:
    case VK_FORMAT_R32G32_SFLOAT:
        return 8;
    case VK_FORMAT_R32G32B32A32_UINT:
    case VK_FORMAT_R32G32B32A32_SFLOAT:
        return 16;
    default:
        throw std::logic_error("texel size of format " + std::to_string(format) + " is not listed");
    }
}

void createTexelView(Device& device, const char* what, Buffer& buffer, VkFormat format) {
    const OnError undo([&] { destroyBuffer(device, buffer); });
    addView(device, what, buffer, format);
}

void uploadBuffer(Device& device, Buffer& buffer, const void* data, std::uint64_t bytes, std::uint64_t offset) {
    requireInside(buffer, bytes, offset);
    if (bytes == 0) return;
    if (!buffer.mapped) {
        buffer.uploaded = device.staging->upload(device, buffer, data, bytes, offset);
        return;
    }
    waitForSubmitted(device);
    std::memcpy(static_cast<std::byte*>(buffer.mapped) + offset, data, bytes);
    flushBuffer(device, buffer);
}

void copyBuffer(Device& device, const Buffer& from, Buffer& to, std::uint64_t bytes) {
    requireInside(from, bytes, 0);
    requireInside(to, bytes, 0);
    if (bytes > 0) copyAndWait(device, from, to, {0, 0, bytes});
}

void downloadBuffer(Device& device, const Buffer& buffer, void* data, std::uint64_t bytes, std::uint64_t offset) {
    requireInside(buffer, bytes, offset);
    if (bytes == 0) return;
    if (buffer.mapped) {
        waitForSubmitted(device);
        std::memcpy(data, hostBytes(device, buffer) + offset, bytes);
    } else {
        device.staging->download(device, buffer, data, bytes, offset);
    }
}

const std::byte* hostBytes(const Device& device, const Buffer& buffer) {
    const VkMappedMemoryRange range = mappedRange(buffer);
    if (!buffer.coherent) check(vkInvalidateMappedMemoryRanges(device.handle, 1, &range), "read what the device wrote");
    return static_cast<const std::byte*>(buffer.mapped);
}

void flushBuffer(const Device& device, const Buffer& buffer) {
    const VkMappedMemoryRange range = mappedRange(buffer);
    if (!buffer.coherent) check(vkFlushMappedMemoryRanges(device.handle, 1, &range), "write for the device");
}

} // namespace pointrt

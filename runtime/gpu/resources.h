// SPDX-License-Identifier: Apache-2.0
// Buffers: allocation, texel views, and the ways of bytes to the device and back.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "runtime/gpu/device.h"

namespace pointrt {

/// A buffer with its own memory. Plain data: free it with destroyBuffer, once.
struct Buffer {
    VkBuffer handle = VK_NULL_HANDLE;
    VkDeviceMemory memory = VK_NULL_HANDLE;
    VkBufferView view = VK_NULL_HANDLE; ///< set by createTexelView
    std::uint64_t bytes = 0;            ///< as asked for; at least 16 are allocated
    void* mapped = nullptr;             ///< coherent; set where the host can reach the memory directly
    bool imported = false;              ///< the memory is the caller's
};

/// kHost memory is mapped and coherent. kDevice memory is mapped only where device.unified_memory is set.
enum class MemoryHome { kDevice, kHost };

/// what names the buffer in messages ("image buffer"). usage gets the transfer bits besides the given ones.
/// Throws Error kCannotRun: out of memory, or larger than the device's largest allocation.
Buffer createBuffer(Device& device, const char* what, std::uint64_t bytes, VkBufferUsageFlags usage,
                    MemoryHome home = MemoryHome::kDevice);
void destroyBuffer(Device& device, Buffer& buffer);

/// createBuffer and uploadBuffer in one: a device buffer holding the bytes at data.
Buffer createFilledBuffer(Device& device, const char* what, const void* data, std::uint64_t bytes,
                          VkBufferUsageFlags usage);

/// A read-only view of the host's bytes as a device buffer without a copy, through VK_EXT_external_memory_host.
/// data must outlive the buffer, with [data, data + bytes rounded up to device.host_import_alignment) readable.
/// Returns a Buffer without handle where that is not possible (no extension, alignment, a driver that refuses the
/// mapping): upload instead. On a device with memory of its own an imported buffer is read over the bus at each use.
Buffer importHostBuffer(Device& device, const void* data, std::uint64_t bytes, VkBufferUsageFlags usage);

/// Bytes of a texel in one of the formats that buffers are read in.
std::uint64_t texelBytes(VkFormat format);

/// Adds a view of the whole buffer for texel fetches in format. The buffer needs the uniform or storage texel usage.
/// Throws Error kCannotRun when there are more texels than the device can address or it cannot read the format; the
/// buffer is destroyed then.
void createTexelView(Device& device, const char* what, Buffer& buffer, VkFormat format);

/// A device buffer of rows for texel fetches in format. Without rows it holds a few blank ones: there must be texels,
/// and lanes without work read the first row.
template <typename Row>
Buffer createTexelRows(Device& device, const char* what, std::vector<Row> rows, VkFormat format) {
    constexpr std::size_t kBlankRows = 4;
    if (rows.empty()) rows.resize(kBlankRows);
    Buffer buffer = createFilledBuffer(device, what, rows.data(), rows.size() * sizeof(Row),
                                       VK_BUFFER_USAGE_UNIFORM_TEXEL_BUFFER_BIT);
    createTexelView(device, what, buffer, format);
    return buffer;
}

/// Copies bytes from data to buffer at offset; returns when they are there. Offset and bytes are multiples of 4.
void uploadBuffer(Device& device, Buffer& buffer, const void* data, std::uint64_t bytes, std::uint64_t offset = 0);
/// Copies bytes at offset of buffer to data; waits for nothing but its own copy.
void downloadBuffer(Device& device, const Buffer& buffer, void* data, std::uint64_t bytes, std::uint64_t offset = 0);

} // namespace pointrt

// SPDX-License-Identifier: Apache-2.0
// Buffers: allocation, texel views, uploads and downloads.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "runtime/gpu/device.h"
#include "runtime/gpu/memory_pool.h"
#include "runtime/gpu/memory_types.h"

namespace pointrt {

/// A buffer. Plain data: free it with destroyBuffer, once.
struct Buffer {
    VkBuffer handle = VK_NULL_HANDLE;
    MemoryRange range;
    VkBufferView view = VK_NULL_HANDLE;               ///< set by createTexelView
    VkAccelerationStructureKHR tree = VK_NULL_HANDLE; ///< the acceleration structure that it stores (box_tree.h)
    std::uint64_t bytes = 0;                          ///< as requested; at least 16 bytes are allocated
    void* mapped = nullptr;     ///< null if the host cannot access the memory quickly (memory_types.h)
    bool coherent = true;       ///< if false, hostBytes and flushBuffer keep mapped up to date
    bool imported = false;      ///< the memory belongs to the caller
    bool placed = false;        ///< the memory belongs to another buffer
    std::uint64_t uploaded = 0; ///< the submission of the last upload
};

/// @param what names the buffer in messages and debuggers ("image buffer")
/// @param usage the transfer bits are added
/// Throws Error kCannotRun if out of memory, or larger than the device's largest allocation.
Buffer createBuffer(Device& device, const char* what, std::uint64_t bytes, VkBufferUsageFlags usage,
                    MemoryHome home = MemoryHome::kDevice);
/// Waits for this thread's submissions first, since they may use the buffer.
void destroyBuffer(Device& device, Buffer& buffer);

/// A buffer in the memory of another one, at offset, a multiple of texelAlignment. The other buffer must outlive it.
Buffer createPlacedBuffer(Device& device, const char* what, std::uint64_t bytes, VkBufferUsageFlags usage,
                          const Buffer& in, std::uint64_t offset);

/// A device buffer with a copy of the bytes at data: createBuffer and uploadBuffer.
Buffer createFilledBuffer(Device& device, const char* what, const void* data, std::uint64_t bytes,
                          VkBufferUsageFlags usage);

/// Imports host memory as a read-only device buffer without a copy, through VK_EXT_external_memory_host. data must
/// outlive the buffer, with [data, data + bytes rounded up to device.host_import_alignment) readable. Returns a Buffer
/// without a handle if that is not possible (no extension, alignment, the driver refuses the mapping): upload instead.
/// A device with its own memory reads an imported buffer over the bus every time.
Buffer importHostBuffer(Device& device, const void* data, std::uint64_t bytes, VkBufferUsageFlags usage);

/// Bytes per texel of the formats that buffer views use.
std::uint64_t texelBytes(VkFormat format);

/// Adds a view of the whole buffer for texel fetches. The buffer needs the uniform or storage texel buffer usage.
/// Throws Error kCannotRun if there are more texels than the device can address or it does not support the format; the
/// buffer is destroyed then.
void createTexelView(Device& device, const char* what, Buffer& buffer, VkFormat format);

/// A device buffer of rows for texel fetches. If there are no rows, it has a few blank ones: a buffer cannot be empty,
/// and idle lanes read the first row.
template <typename Row>
Buffer createTexelRows(Device& device, const char* what, std::vector<Row> rows, VkFormat format) {
    constexpr std::size_t kBlankRows = 4;
    if (rows.empty()) rows.resize(kBlankRows);
    Buffer buffer = createFilledBuffer(device, what, rows.data(), rows.size() * sizeof(Row),
                                       VK_BUFFER_USAGE_UNIFORM_TEXEL_BUFFER_BIT);
    createTexelView(device, what, buffer, format);
    return buffer;
}

/// Copies bytes from data to buffer at offset, both multiples of 4, before all later submissions and after this
/// thread's earlier ones. No other thread's submission that uses the buffer may still be running.
void uploadBuffer(Device& device, Buffer& buffer, const void* data, std::uint64_t bytes, std::uint64_t offset = 0);
/// Copies the first bytes of a buffer to the start of another, and waits.
void copyBuffer(Device& device, const Buffer& from, Buffer& to, std::uint64_t bytes);
/// Copies bytes at offset of buffer to data, after this thread's earlier submissions.
void downloadBuffer(Device& device, const Buffer& buffer, void* data, std::uint64_t bytes, std::uint64_t offset = 0);

/// The mapped bytes of a buffer as left by the device's submissions, which must be done.
const std::byte* hostBytes(const Device& device, const Buffer& buffer);
/// Makes what the host wrote to the mapped bytes visible to later submissions.
void flushBuffer(const Device& device, const Buffer& buffer);

} // namespace pointrt

// SPDX-License-Identifier: Apache-2.0
// Large buffers that contain many texel buffers, so that a program reads all of them through one binding each.
#pragma once

#include <cstdint>
#include <list>
#include <mutex>

#include "runtime/gpu/free_ranges.h"
#include "runtime/gpu/resources.h"

namespace pointrt {

/// A buffer with views of all of it.
struct TexelBlock {
    Buffer words, quads; ///< the same buffer with texels of one and of four uint32
    FreeRanges gaps{0};
};

/// A part of a block. Plain data: return it with TexelPool::free, once.
struct TexelRange {
    const TexelBlock* block = nullptr; ///< null: none
    std::uint64_t offset = 0, bytes = 0;
};

/// Thread-safe.
class TexelPool {
public:
    /// A range of this many bytes, the texelRoom of its buffers; without a block if no block can be that large. Throws
    /// Error kCannotRun if out of memory.
    TexelRange allocate(Device& device, std::uint64_t bytes);
    /// Ignores ranges without a block.
    void free(Device& device, const TexelRange& range);
    /// Frees all blocks; their ranges must not be used any more.
    void clear(Device& device);
    /// Number of blocks.
    std::size_t size();

private:
    TexelBlock& addBlock(Device& device, std::uint64_t needed);

    std::mutex mutex_;
    std::list<TexelBlock> blocks_;
};

/// Alignment of buffers in a block, bytes.
std::uint64_t texelAlignment(const Device& device);
/// The bytes of a range that a buffer of this size takes.
std::uint64_t texelRoom(const Device& device, std::uint64_t bytes);

/// Places the buffers of a range one after the other.
class TexelPlacer {
public:
    explicit TexelPlacer(const TexelRange& range) : range_(range) {}
    /// A texel buffer with a copy of the bytes at data, in the range. Throws Error as createTexelView does, and
    /// std::logic_error if the range is too small.
    Buffer place(Device& device, const char* what, const void* data, std::uint64_t bytes, VkFormat format);

private:
    TexelRange range_;
    std::uint64_t used_ = 0;
};

} // namespace pointrt

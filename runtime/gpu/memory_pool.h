// SPDX-License-Identifier: Apache-2.0
// Sub-allocation of device memory: few large allocations for many buffers. An allocation takes 0.1 ms or more, and
// drivers may limit their number to 4096.
#pragma once

#include <cstddef>
#include <cstdint>
#include <list>
#include <mutex>

#include "runtime/gpu/free_ranges.h"
#include "runtime/gpu/vulkan.h"

namespace pointrt {

struct Device;

/// A part of an allocation. Plain data: return it with MemoryPool::free, once.
struct MemoryRange {
    VkDeviceMemory memory = VK_NULL_HANDLE;
    std::uint64_t offset = 0, bytes = 0;
    std::uint32_t type = 0;
    void* mapped = nullptr;
};

/// Thread-safe.
class MemoryPool {
public:
    /// Throws Error kCannotRun "cannot ACTION: ..." if out of memory.
    /// @param map whether to map the memory; its type must then be host-visible
    MemoryRange allocate(const Device& device, const VkMemoryRequirements& requirements, std::uint32_t type, bool map,
                         const char* action);
    void free(const Device& device, const MemoryRange& range);
    /// Frees all allocations; their ranges must not be used any more.
    void clear(const Device& device);
    /// Number of allocations.
    std::size_t size();

private:
    struct Block {
        VkDeviceMemory memory = VK_NULL_HANDLE;
        std::uint32_t type = 0;
        bool is_shared = false; ///< by several ranges
        void* mapped = nullptr;
        FreeRanges gaps;
    };
    Block& addBlock(const Device& device, std::uint64_t bytes, std::uint32_t type, bool map, const char* action);
    bool isLastShared(const Block& block) const;
    static bool takeFrom(Block& block, const VkMemoryRequirements& requirements, MemoryRange& range);

    std::mutex mutex_;
    std::list<Block> blocks_;
};

} // namespace pointrt

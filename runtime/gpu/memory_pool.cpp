// SPDX-License-Identifier: Apache-2.0
#include "runtime/gpu/memory_pool.h"

#include <algorithm>
#include <cstddef>
#include <string>

#include "runtime/gpu/device.h"

namespace pointrt {
namespace {

/// Shared blocks: large enough that the buffers of a scene share a few, small enough to leave little unused.
constexpr std::uint64_t kBlockBytes = 16ull << 20;
/// Larger ranges get an allocation of their own, so that at most a quarter of a block is lost at its end.
constexpr std::uint64_t kLargestShared = kBlockBytes / 4;

std::uint64_t roundedUp(std::uint64_t value, std::uint64_t step) { return (value + step - 1) / step * step; }

} // namespace

MemoryRange MemoryPool::allocate(const Device& device, const VkMemoryRequirements& requirements, std::uint32_t type,
                                 bool map, const char* action) {
    VkMemoryRequirements needs = requirements;
    if (map) { // flushes and invalidates cover whole atoms
        const std::uint64_t atom = std::max<std::uint64_t>(device.limits.nonCoherentAtomSize, 1);
        needs.alignment = roundedUp(std::max<std::uint64_t>(needs.alignment, 1), atom);
        needs.size = roundedUp(needs.size, atom);
    }
    const std::lock_guard lock(mutex_);
    MemoryRange range;
    if (needs.size <= kLargestShared)
        for (Block& block : blocks_)
            if (block.is_shared && block.type == type && (block.mapped != nullptr) == map &&
                takeFrom(block, needs, range))
                return range;
    const bool shares = needs.size <= kLargestShared;
    Block& block = addBlock(device, shares ? kBlockBytes : needs.size, type, map, action);
    block.is_shared = shares;
    takeFrom(block, needs, range);
    return range;
}

MemoryPool::Block& MemoryPool::addBlock(const Device& device, std::uint64_t bytes, std::uint32_t type, bool map,
                                        const char* action) {
    Block block{VK_NULL_HANDLE, type, false, nullptr, FreeRanges(bytes)};
    VkMemoryAllocateInfo info{VK_STRUCTURE_TYPE_MEMORY_ALLOCATE_INFO};
    info.allocationSize = bytes;
    info.memoryTypeIndex = type;
    VkMemoryAllocateFlagsInfo flags{VK_STRUCTURE_TYPE_MEMORY_ALLOCATE_FLAGS_INFO};
    flags.flags = VK_MEMORY_ALLOCATE_DEVICE_ADDRESS_BIT;
    if (device.queries_rays) info.pNext = &flags; // acceleration structures are built from addresses
    check(vkAllocateMemory(device.handle, &info, nullptr, &block.memory), action);
    if (map) {
        const VkResult mapped = vkMapMemory(device.handle, block.memory, 0, VK_WHOLE_SIZE, 0, &block.mapped);
        if (mapped != VK_SUCCESS) vkFreeMemory(device.handle, block.memory, nullptr);
        check(mapped, action);
    }
    return blocks_.emplace_back(std::move(block));
}

bool MemoryPool::takeFrom(Block& block, const VkMemoryRequirements& requirements, MemoryRange& range) {
    const auto offset = block.gaps.take(requirements.size, requirements.alignment);
    if (!offset) return false;
    range = {block.memory, *offset, requirements.size, block.type,
             block.mapped ? static_cast<std::byte*>(block.mapped) + *offset : nullptr};
    return true;
}

void MemoryPool::free(const Device& device, const MemoryRange& range) {
    const std::lock_guard lock(mutex_);
    const auto block =
        std::find_if(blocks_.begin(), blocks_.end(), [&](const Block& each) { return each.memory == range.memory; });
    if (block == blocks_.end()) return;
    block->gaps.give(range.offset, range.bytes);
    if (!block->gaps.areAll() || isLastShared(*block)) return;
    vkFreeMemory(device.handle, block->memory, nullptr);
    blocks_.erase(block);
}

/// Whether this is the only shared block of its kind of memory: the last one is kept for buffers that come and go.
bool MemoryPool::isLastShared(const Block& block) const {
    return block.is_shared && std::none_of(blocks_.begin(), blocks_.end(), [&](const Block& other) {
               return &other != &block && other.is_shared && other.type == block.type &&
                      (other.mapped != nullptr) == (block.mapped != nullptr);
           });
}

void MemoryPool::clear(const Device& device) {
    const std::lock_guard lock(mutex_);
    for (const Block& block : blocks_) vkFreeMemory(device.handle, block.memory, nullptr);
    blocks_.clear();
}

std::size_t MemoryPool::size() {
    const std::lock_guard lock(mutex_);
    return blocks_.size();
}

} // namespace pointrt

// SPDX-License-Identifier: Apache-2.0
#include "runtime/gpu/texel_pool.h"

#include <algorithm>
#include <numeric>

#include "format/base/error.h"
#include "runtime/gpu/device.h"
#include "runtime/gpu/paged_buffer.h"
#include "runtime/util/on_error.h"

namespace pointrt {
namespace {

/// Each block is as large as all earlier ones together, so that a large set has few blocks and at most half of the
/// memory is unused. The smallest block holds about a million splats with their index.
constexpr std::uint64_t kSmallestBlock = 64ull << 20;
/// The largest has 2^27 words, the most texels of a view that common devices support, and can be bound as a storage
/// buffer.
constexpr std::uint64_t kLargestBlock = 512ull << 20;

std::uint64_t largestBlock(const Device& device) {
    const std::uint64_t words = std::uint64_t{device.limits.maxTexelBufferElements} * sizeof(std::uint32_t);
    return std::min(
        {kLargestBlock, words, device.max_allocation_bytes, std::uint64_t{device.limits.maxStorageBufferRange}});
}

TexelBlock createBlock(Device& device, std::uint64_t bytes) {
    constexpr const char* kWhat = "texel block";
    TexelBlock block{{}, {}, FreeRanges(bytes)};
    block.words = createBuffer(device, kWhat, bytes, texelUsage(VK_FORMAT_R32_UINT));
    createTexelView(device, kWhat, block.words, VK_FORMAT_R32_UINT);
    const OnError undo([&] { vkDestroyBufferView(device.handle, block.words.view, nullptr); });
    block.quads = block.words;
    createTexelView(device, kWhat, block.quads, VK_FORMAT_R32G32B32A32_UINT); // destroys the buffer if it fails
    return block;
}

void destroyBlock(Device& device, TexelBlock& block) {
    vkDestroyBufferView(device.handle, block.quads.view, nullptr);
    destroyBuffer(device, block.words);
}

} // namespace

TexelRange TexelPool::allocate(Device& device, std::uint64_t bytes) {
    if (bytes > largestBlock(device)) return {};
    const std::uint64_t alignment = texelAlignment(device);
    const std::lock_guard lock(mutex_);
    for (TexelBlock& block : blocks_)
        if (const auto offset = block.gaps.take(bytes, alignment)) return {&block, *offset, bytes};
    TexelBlock& block = addBlock(device, bytes);
    return {&block, block.gaps.take(bytes, alignment).value(), bytes};
}

/// A block for at least this many bytes; smaller than usual if memory is scarce.
TexelBlock& TexelPool::addBlock(Device& device, std::uint64_t needed) {
    const std::uint64_t present =
        std::accumulate(blocks_.begin(), blocks_.end(), std::uint64_t{0},
                        [](std::uint64_t sum, const TexelBlock& block) { return sum + block.words.bytes; });
    const std::uint64_t usual = std::max(needed, std::clamp(present, kSmallestBlock, kLargestBlock));
    try {
        return blocks_.emplace_back(createBlock(device, std::min(usual, largestBlock(device))));
    } catch (const Error&) {
        return blocks_.emplace_back(createBlock(device, needed));
    }
}

void TexelPool::free(Device& device, const TexelRange& range) {
    if (!range.block) return;
    const std::lock_guard lock(mutex_);
    const auto block =
        std::find_if(blocks_.begin(), blocks_.end(), [&](const TexelBlock& each) { return &each == range.block; });
    if (block == blocks_.end()) return;
    block->gaps.give(range.offset, range.bytes);
    if (!block->gaps.areAll()) return;
    destroyBlock(device, *block);
    blocks_.erase(block);
}

void TexelPool::clear(Device& device) {
    const std::lock_guard lock(mutex_);
    for (TexelBlock& block : blocks_) destroyBlock(device, block);
    blocks_.clear();
}

std::size_t TexelPool::size() {
    const std::lock_guard lock(mutex_);
    return blocks_.size();
}

std::uint64_t texelAlignment(const Device& device) {
    // flushes cover whole atoms; devices align buffers to at most 256 bytes, which createPlacedBuffer checks
    constexpr std::uint64_t kBufferAlignment = 256;
    return std::max<std::uint64_t>(kBufferAlignment, device.limits.nonCoherentAtomSize);
}

std::uint64_t texelRoom(const Device& device, std::uint64_t bytes) {
    const std::uint64_t alignment = texelAlignment(device);
    return (bytes / alignment + 1) * alignment; // even an empty buffer takes some room
}

Buffer TexelPlacer::place(Device& device, const char* what, const void* data, std::uint64_t bytes, VkFormat format) {
    Buffer buffer =
        createPlacedBuffer(device, what, bytes, texelUsage(format), range_.block->words, range_.offset + used_);
    const OnError undo([&] { destroyBuffer(device, buffer); });
    used_ += texelRoom(device, bytes);
    uploadBuffer(device, buffer, data, bytes);
    createTexelView(device, what, buffer, format);
    return buffer;
}

} // namespace pointrt

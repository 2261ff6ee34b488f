// SPDX-License-Identifier: Apache-2.0
#include "runtime/gpu/staging.h"

#include <algorithm>
#include <cstring>

namespace pointrt {
namespace {

/// Chunk size: at the 12 GB/s of PCI Express 3 a chunk takes 0.7 ms, which hides the cost of a submission.
constexpr std::uint64_t kChunkBytes = 8ull << 20;
/// Room for two chunks that the device copies while the host fills a third, and for small uploads in between.
constexpr std::uint64_t kRingBytes = 4 * kChunkBytes;
constexpr std::uint64_t kReadChunks = 2;
/// Copies start at multiples of the largest texel.
constexpr std::uint64_t kAlignment = 16;

std::uint64_t submitCopy(Device& device, const Buffer& from, const Buffer& to, const VkBufferCopy& region) {
    const VkCommandBuffer commands = beginCommands(device, "buffer copy");
    vkCmdCopyBuffer(commands, from.handle, to.handle, 1, &region);
    return submit(device, commands);
}

} // namespace

/// Waits until a place in the ring has room for bytes: until no running copy reads from there.
std::uint64_t Staging::takeRoom(Device& device, std::uint64_t bytes) {
    if (!ring_.handle) ring_ = createBuffer(device, "staging ring", kRingBytes, 0, MemoryHome::kUpload);
    if (next_ + bytes > kRingBytes) next_ = 0;
    const std::uint64_t begin = next_, end = begin + bytes;
    while (std::any_of(copies_.begin(), copies_.end(),
                       [&](const Copy& each) { return each.begin < end && begin < each.end; })) {
        waitFor(device, copies_.front().submission);
        copies_.pop_front();
    }
    next_ = (end + kAlignment - 1) / kAlignment * kAlignment;
    return begin;
}

std::uint64_t Staging::upload(Device& device, const Buffer& to, const void* data, std::uint64_t bytes,
                              std::uint64_t offset) {
    std::uint64_t submission = 0;
    for (std::uint64_t start = 0; start < bytes; start += kChunkBytes) {
        const std::uint64_t count = std::min(bytes - start, kChunkBytes), place = takeRoom(device, count);
        std::memcpy(static_cast<std::byte*>(ring_.mapped) + place, static_cast<const std::byte*>(data) + start, count);
        submission = submitCopy(device, ring_, to, {place, offset + start, count});
        copies_.push_back({place, place + count, submission});
    }
    return submission;
}

std::uint64_t Staging::submitDownload(Device& device, const Buffer& from, std::uint64_t chunk, std::uint64_t bytes,
                                      std::uint64_t offset) {
    const std::uint64_t start = chunk * kChunkBytes, place = chunk % kReadChunks * kChunkBytes;
    return submitCopy(device, from, read_, {offset + start, place, std::min(bytes - start, kChunkBytes)});
}

/// While the host reads a chunk, the device copies the next one.
void Staging::download(Device& device, const Buffer& from, void* data, std::uint64_t bytes, std::uint64_t offset) {
    if (!read_.handle)
        read_ = createBuffer(device, "readback buffer", kReadChunks * kChunkBytes, 0, MemoryHome::kReadback);
    const std::uint64_t chunks = (bytes + kChunkBytes - 1) / kChunkBytes;
    std::uint64_t submission = submitDownload(device, from, 0, bytes, offset);
    for (std::uint64_t chunk = 0; chunk < chunks; ++chunk) {
        const std::uint64_t ready = submission;
        if (chunk + 1 < chunks) submission = submitDownload(device, from, chunk + 1, bytes, offset);
        waitFor(device, ready);
        const std::uint64_t start = chunk * kChunkBytes, place = chunk % kReadChunks * kChunkBytes;
        std::memcpy(static_cast<std::byte*>(data) + start, hostBytes(device, read_) + place,
                    std::min(bytes - start, kChunkBytes));
    }
}

void Staging::clear(Device& device) {
    destroyBuffer(device, ring_);
    destroyBuffer(device, read_);
    copies_.clear();
    next_ = 0;
}

} // namespace pointrt

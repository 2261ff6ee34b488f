// SPDX-License-Identifier: Apache-2.0
// Ranges in large blocks: allocated ranges do not overlap, freed ranges are reused completely, and data stays in its
// place.
#include "runtime/gpu/texel_pool.h"

#include <gtest/gtest.h>

#include <cstdint>
#include <numeric>
#include <vector>

#include "tests/support/validated_device.h"

namespace pointrt::test {
namespace {

TEST(FreeRanges, AreTakenInOrderAndAligned) {
    FreeRanges ranges(100);
    EXPECT_EQ(ranges.take(10, 1), 0u);
    EXPECT_EQ(ranges.take(10, 16), 16u);
    EXPECT_EQ(ranges.take(6, 1), 10u) << "the gap before the aligned range";
    EXPECT_FALSE(ranges.take(75, 1));
    EXPECT_EQ(ranges.take(74, 1), 26u);
    EXPECT_FALSE(ranges.take(1, 1));
    EXPECT_FALSE(ranges.areAll());
}

TEST(FreeRanges, JoinTheirNeighbours) {
    FreeRanges ranges(30);
    for (int k = 0; k < 3; ++k) ranges.take(10, 1);
    ranges.give(0, 10);
    ranges.give(20, 10);
    EXPECT_FALSE(ranges.take(20, 1));
    ranges.give(10, 10);
    EXPECT_TRUE(ranges.areAll());
    EXPECT_EQ(ranges.take(30, 1), 0u);
}

std::vector<std::uint32_t> wordsFrom(std::uint32_t first, std::size_t count) {
    std::vector<std::uint32_t> words(count);
    std::iota(words.begin(), words.end(), first);
    return words;
}

class TexelPoolOnDevice : public DeviceFixture {
protected:
    /// The words at a buffer's place in the block.
    std::vector<std::uint32_t> inBlock(const TexelRange& range, const Buffer& buffer) {
        const Buffer& block = range.block->words;
        std::vector<std::uint32_t> words(buffer.bytes / sizeof(std::uint32_t));
        downloadBuffer(device, block, words.data(), buffer.bytes, buffer.range.offset - block.range.offset);
        return words;
    }
    TexelPool pool;
};

TEST_F(TexelPoolOnDevice, HoldsWhatIsPlaced) {
    const auto few = wordsFrom(1, 4), many = wordsFrom(1000, 1000);
    const std::uint64_t room = 8 * texelAlignment(device) + many.size() * sizeof many[0];
    const TexelRange ranges[] = {pool.allocate(device, room), pool.allocate(device, room)};
    EXPECT_EQ(ranges[0].block, ranges[1].block);
    std::vector<Buffer> buffers;
    for (const TexelRange& range : ranges) {
        TexelPlacer placer(range);
        buffers.push_back(placer.place(device, "few", few.data(), few.size() * 4, VK_FORMAT_R32_UINT));
        buffers.push_back(placer.place(device, "many", many.data(), many.size() * 4, VK_FORMAT_R32G32B32A32_UINT));
    }
    for (std::size_t k = 0; k < buffers.size(); ++k)
        EXPECT_EQ(inBlock(ranges[k / 2], buffers[k]), k % 2 == 0 ? few : many);
    for (Buffer& buffer : buffers) destroyBuffer(device, buffer);
    for (const TexelRange& range : ranges) pool.free(device, range);
    EXPECT_EQ(pool.size(), 0u) << "an empty block is freed";
}

TEST_F(TexelPoolOnDevice, HasNoRangeForWhatABlockCannotHold) {
    device.limits.maxTexelBufferElements = 1 << 16;
    constexpr std::uint64_t kLargest = (1 << 16) * sizeof(std::uint32_t);
    EXPECT_FALSE(pool.allocate(device, kLargest + 1).block);
    const TexelRange whole = pool.allocate(device, kLargest), next = pool.allocate(device, 1);
    ASSERT_TRUE(whole.block && next.block);
    EXPECT_NE(whole.block, next.block);
    EXPECT_EQ(pool.size(), 2u);
    pool.clear(device);
}

TEST_F(TexelPoolOnDevice, RefusesBuffersBeyondTheBlock) {
    const auto words = wordsFrom(0, 1 << 16);
    device.limits.maxTexelBufferElements = 1 << 16;
    const TexelRange range = pool.allocate(device, words.size() * 4);
    TexelPlacer placer(range);
    Buffer buffer = placer.place(device, "all", words.data(), words.size() * 4, VK_FORMAT_R32_UINT);
    EXPECT_THROW(placer.place(device, "more", words.data(), 4, VK_FORMAT_R32_UINT), std::logic_error);
    destroyBuffer(device, buffer);
    pool.clear(device);
}

} // namespace
} // namespace pointrt::test

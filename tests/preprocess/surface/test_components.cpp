// SPDX-License-Identifier: Apache-2.0
#include "preprocess/surface/components.h"

#include <gtest/gtest.h>
#include <tbb/parallel_for.h>

namespace pointrt::test {
namespace {

using surface::ParitySets;
using surface::SharedSets;

TEST(SharedSets, ThreadsJoinToTheLowestPoint) {
    constexpr std::uint32_t kCount = 100'000, kSets = 7;
    SharedSets sets(kCount);
    // joins points with the same remainder from both ends at once, each edge twice
    tbb::parallel_for(std::uint32_t(0), kCount - kSets, [&](std::uint32_t i) {
        sets.join(i, i + kSets);
        sets.join(kCount - 1 - i, kCount - 1 - i - kSets);
    });
    for (std::uint32_t i = 0; i < kCount; ++i) ASSERT_EQ(sets.find(i), i % kSets);
}

TEST(ParitySets, FlattenKeepsRootsAndParities) {
    constexpr std::uint32_t kCount = 1000;
    ParitySets sets(kCount);
    for (std::uint32_t i = 0; i + 2 < kCount; ++i) EXPECT_TRUE(sets.join(i, i + 2, i % 3 == 0));
    EXPECT_FALSE(sets.join(0, kCount - 2, true));
    ParitySets flat = sets;
    flat.flatten();
    for (std::uint32_t i = 0; i < kCount; ++i) {
        EXPECT_EQ(flat.find(i), sets.find(i));
        EXPECT_EQ(flat.rootOf(i), sets.find(i).first);
        EXPECT_EQ(flat.rootOf(i) == flat.rootOf(0), i % 2 == 0);
    }
}

} // namespace
} // namespace pointrt::test

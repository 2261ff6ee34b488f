// SPDX-License-Identifier: Apache-2.0
#include "format/os/heap.h"

#include <gtest/gtest.h>

#include <cstdlib>
#include <fstream>
#include <memory>
#include <vector>

namespace pointrt::test {
namespace {

#if defined(__GLIBC__) && !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)
constexpr long kPage = 4096, kBlock = 8 << 20;

long residentBytes() {
    long all = 0, resident = 0;
    std::ifstream("/proc/self/statm") >> all >> resident;
    return resident * kPage;
}

TEST(Heap, ReturnsLargeBlocksThoughSmallOnesFollow) {
    returnLargeBlocks();
    std::vector<char>(kBlock, 1); // freeing it would make glibc keep such blocks
    std::vector<std::vector<char>> blocks, small;
    for (int i = 0; i < 4; ++i) {
        blocks.emplace_back(kBlock, 1);
        small.emplace_back(1 << 16, 1);
    }
    const long before = residentBytes();
    blocks.clear();
    EXPECT_LT(residentBytes(), before - 3 * kBlock);
}
#endif

} // namespace
} // namespace pointrt::test

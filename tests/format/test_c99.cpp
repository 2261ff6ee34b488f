// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <cstdint>

extern "C" std::uint32_t splatsFromC(const char* path);

TEST(C99, OpensAFile) {
    EXPECT_EQ(splatsFromC(POINTRT_GOLDEN_DIR "/tiny_v1_4.pro"), 5u);
    EXPECT_EQ(splatsFromC("missing.pro"), 0u);
}

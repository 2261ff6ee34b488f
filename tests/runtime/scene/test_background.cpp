// SPDX-License-Identifier: Apache-2.0
#include "runtime/scene/background.h"

#include <gtest/gtest.h>

#include "runtime/image/tonemap.h"

namespace pointrt {
namespace {

TEST(Background, HasWordsAndColours) {
    EXPECT_EQ(backgroundNamed("black"), Background{});
    EXPECT_EQ(backgroundNamed("white"), (Background{{255, 255, 255}, false}));
    EXPECT_EQ(backgroundNamed("transparent"), (Background{{0, 0, 0}, true}));
    EXPECT_EQ(backgroundNamed("#0aFf80"), (Background{{10, 255, 128}, false}));
    EXPECT_EQ(backgroundNamed("#ffffff"), backgroundNamed("white"));
}

TEST(Background, RefusesOtherWords) {
    for (const char* word : {"", "grey", "Black", "black ", "#fff", "0a80ff", "#0a80f", "#0a80ff0", "#0a80fg",
                             "#-1-1-1", "#+1+1+1", "# a b c"})
        EXPECT_FALSE(backgroundNamed(word)) << word;
}

TEST(Background, HasTheNameItIsReadFrom) {
    for (const char* word : {"black", "white", "transparent", "#0aff80"})
        EXPECT_EQ(backgroundName(*backgroundNamed(word)), word);
    EXPECT_EQ(backgroundName(*backgroundNamed("#000000")), "black");
    EXPECT_EQ(backgroundName(*backgroundNamed("#0AFF80")), "#0aff80");
}

// 128 / 255 by hand: ((0.50196 + 0.055) / 1.055)^2.4; 10 / 255 is on the line: 0.039216 / 12.92.
TEST(Background, RadianceIsDecodedSrgb) {
    const Color radiance = backgroundRadiance({{10, 128, 255}, false});
    EXPECT_NEAR(radiance[0], 0.0030353f, 1e-7);
    EXPECT_NEAR(radiance[1], 0.2158605f, 1e-7);
    EXPECT_EQ(radiance[2], 1.0f);
}

TEST(Background, EveryColourComesOutOfThePngAsGiven) {
    for (int byte = 0; byte < 256; ++byte) {
        const auto value = static_cast<std::uint8_t>(byte);
        EXPECT_EQ(encodeSrgb(backgroundRadiance({{value, value, value}, false})[0]), value);
    }
}

} // namespace
} // namespace pointrt

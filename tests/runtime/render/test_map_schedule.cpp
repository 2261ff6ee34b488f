// SPDX-License-Identifier: Apache-2.0
#include "runtime/render/map_schedule.h"

#include <gtest/gtest.h>

#include <cmath>

namespace pointrt {
namespace {

/// The number of samples that use the first map.
std::uint32_t samplesOfAMap(std::uint64_t pixels) {
    std::uint32_t sample = 0;
    while (sample < 1u << 20 && mapOfSample(sample, pixels) == 0) ++sample;
    return sample;
}

TEST(MapSchedule, EveryMapHasTheSameNumberOfSamples) {
    EXPECT_EQ(samplesOfAMap(512 * 512), 4u);
    for (std::uint32_t sample = 0; sample < 100; ++sample) EXPECT_EQ(mapOfSample(sample, 512 * 512), sample / 4);
}

TEST(MapSchedule, SmallPicturesHaveMoreSamplesPerMap) {
    EXPECT_EQ(samplesOfAMap(256 * 256), 8u);
    EXPECT_EQ(samplesOfAMap(128 * 128), 16u);
    EXPECT_EQ(samplesOfAMap(1280 * 720), 2u);
    EXPECT_EQ(samplesOfAMap(16384ull * 16384), 1u);
    EXPECT_EQ(samplesOfAMap(1), 2048u);
    EXPECT_EQ(samplesOfAMap(0), 2048u);
}

TEST(MapSchedule, DiscsShrinkAsByKnausAndZwicker) {
    EXPECT_EQ(discShrink(0), 1);
    for (std::uint32_t map = 1; map < 50; ++map) {
        const double ratio = std::pow(discShrink(map) / discShrink(map - 1), 2);
        EXPECT_NEAR(ratio, (map + 2.0 / 3) / (map + 1), 1e-12);
    }
    // areas decrease with the cube root of the number of maps, so that both blur and noise vanish
    EXPECT_NEAR(discShrink(64'000) / discShrink(1000), std::pow(64, -1.0 / 6), 1e-3);
}

} // namespace
} // namespace pointrt

// SPDX-License-Identifier: Apache-2.0
#include "runtime/image/tonemap.h"

#include <gtest/gtest.h>

#include <limits>

namespace pointrt {
namespace {

TEST(ToneMap, LeavesColoursBelowTheShoulder) {
    const std::array<float, 3> colour = {0.1f, 0.5f, 0.79f};
    EXPECT_EQ(toneMap(colour), colour);
}

// By hand from the formula: new peak = 1 - 0.2^2 / (p - 0.6), whiteness = 1 - 1 / (0.15 (p - new peak) + 1).
TEST(ToneMap, CompressesHighlights) {
    const std::array<float, 3> white = toneMap({1, 1, 1});
    for (float channel : white) EXPECT_NEAR(channel, 0.9f, 1e-6);
    const std::array<float, 3> red = toneMap({4.6f, 0, 0});
    EXPECT_NEAR(red[0], 0.99f, 1e-6);
    EXPECT_NEAR(red[1], 0.99f * (1 - 1 / (0.15f * 3.61f + 1)), 1e-6);
    EXPECT_EQ(red[1], red[2]);
}

TEST(ToneMap, IsContinuousAndMonotonousIntoTheShoulder) {
    float before = 0;
    for (int i = 0; i <= 1000; ++i) {
        const float grey = 0.004f * static_cast<float>(i), mapped = toneMap({grey, grey, grey})[0];
        EXPECT_GE(mapped, before);
        EXPECT_LE(mapped - before, 0.0041f);
        EXPECT_LE(mapped, 1.0f);
        before = mapped;
    }
}

TEST(ToneMap, AcceptsNaNAndInfinity) {
    const float nan = std::numeric_limits<float>::quiet_NaN(), infinity = std::numeric_limits<float>::infinity();
    EXPECT_EQ(toneMap({nan, -1, 0.5f}), (std::array<float, 3>{0, 0, 0.5f}));
    for (float channel : toneMap({infinity, 1, 0})) EXPECT_TRUE(channel >= 0 && channel <= 1) << channel;
    EXPECT_EQ(encodeSrgb(nan), 0);
    EXPECT_EQ(encodeSrgb(infinity), 255);
    EXPECT_EQ(encodeSrgb(-infinity), 0);
}

TEST(Srgb, KnownValues) {
    EXPECT_EQ(encodeSrgb(0), 0);
    EXPECT_EQ(encodeSrgb(1), 255);
    EXPECT_EQ(encodeSrgb(0.5f), 188);
    EXPECT_EQ(encodeSrgb(0.2158605f), 128); // ((128 / 255 + 0.055) / 1.055)^2.4
    EXPECT_EQ(encodeSrgb(0.001f), 3);       // in the linear part of the curve
}

TEST(Develop, WritesOpaquePicturesAsRgb) {
    const Image8 image = tonemapFilm({2, 1, {0, 0.5f, 1, 1, 0.25f, 0, 0, 1}, {}, {}, {}});
    EXPECT_EQ(image.channels, 3u);
    EXPECT_EQ(image.pixels.size(), 6u);
    EXPECT_EQ(image.pixels[3], encodeSrgb(0.25f));
}

TEST(Develop, KeepsTheBackground) {
    const Image8 image = tonemapFilm({1, 1, {0.25f, 0, 0, 0}, {}, {}, {}});
    EXPECT_EQ(image.pixels, (std::vector<std::uint8_t>{encodeSrgb(0.25f), 0, 0}));
}

TEST(Develop, ClipsHighlightsWithoutTheCurve) {
    const ToneMapping clipped{0, false};
    const Image8 image = tonemapFilm({2, 1, {0.9f, 0.5f, 0.1f, 1, 1, 3, -1, 1}, {}, {}, {}}, clipped);
    EXPECT_EQ(image.pixels, (std::vector<std::uint8_t>{encodeSrgb(0.9f), 188, encodeSrgb(0.1f), 255, 255, 0}));
    EXPECT_EQ(image.pixels[0], 243) << "255 (1.055 0.9^(1 / 2.4) - 0.055)";
    EXPECT_EQ(tonemapFilm({1, 1, {0.45f, 0, 0, 1}, {}, {}, {}}, {1, false}).pixels[0], 243) << "exposed first";
}

TEST(Develop, WritesStraightAlpha) {
    const ToneMapping transparent{0, false, true};
    // half covered by 0.5, uncovered, covered, and more light than coverage
    const Film film{4, 1, {0.25f, 0.125f, 0, 0.5f, 0.7f, 0, 0, 0, 0.5f, 1, 0, 1, 0.5f, 0, 0, 0.25f}, {}, {}, {}};
    const Image8 image = tonemapFilm(film, transparent);
    EXPECT_EQ(image.channels, 4u);
    EXPECT_EQ(image.pixels, (std::vector<std::uint8_t>{188, encodeSrgb(0.25f), 0, 128, //
                                                       0, 0, 0, 0,                     //
                                                       188, 255, 0, 255,               //
                                                       255, 0, 0, 64}));
    const float nan = std::numeric_limits<float>::quiet_NaN();
    EXPECT_EQ(tonemapFilm({1, 1, {nan, 1, 1, nan}, {}, {}, {}}, transparent).pixels,
              (std::vector<std::uint8_t>{0, 0, 0, 0}));
}

TEST(Develop, ExposesInStops) {
    Film film{1, 1, {0.25f, 0.125f, 0, 1}, {}, {}, {}};
    EXPECT_EQ(tonemapFilm(film, {1}).pixels, (std::vector<std::uint8_t>{encodeSrgb(0.5f), encodeSrgb(0.25f), 0}));
    EXPECT_EQ(tonemapFilm(film, {-1}).pixels, (std::vector<std::uint8_t>{encodeSrgb(0.125f), encodeSrgb(0.0625f), 0}));
    EXPECT_EQ(tonemapFilm(film, {0}).pixels, tonemapFilm(film).pixels);
}

} // namespace
} // namespace pointrt

// SPDX-License-Identifier: Apache-2.0
#include "runtime/scene/legend_picture.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace pointrt {
namespace {

using Pixels = std::vector<std::uint8_t>;

constexpr PixelSize kPicture{512, 400};

Pixels greyPicture(PixelSize size) { return Pixels(std::size_t{3} * size.width * size.height, 100); }

Srgb8 pixelAt(const Pixels& picture, std::size_t x, std::size_t y) {
    const std::uint8_t* at = &picture[3 * (y * kPicture.width + x)];
    return {at[0], at[1], at[2]};
}

Pixels withLegend(const Legend& legend) {
    Pixels picture = greyPicture(kPicture);
    compositeBox(drawLegend(legend, kPicture), {picture, kPicture.width, 0});
    return picture;
}

TEST(LegendPicture, ShowsEveryColourOfTheBar) {
    const Legend legend = barLegend("height (m)", ColorMap::kViridis, {0, 10});
    const Pixels picture = withLegend(legend);
    const auto has = [&](Srgb8 color) {
        for (std::size_t y = 0; y < kPicture.height; ++y)
            for (std::size_t x = 0; x < kPicture.width; ++x)
                if (pixelAt(picture, x, y) == color) return true;
        return false;
    };
    EXPECT_TRUE(has(legend.bar.front()));
    EXPECT_TRUE(has(legend.bar[128]) || has(legend.bar[129]));
    EXPECT_TRUE(has({255, 255, 255})) << "letters";
    EXPECT_TRUE(has({35, 35, 35})) << "the background: 90 / 255 of the picture's 100";
}

TEST(LegendPicture, IsInTheLowerLeftCorner) {
    const Legend legend = barLegend("height", ColorMap::kMagma, {0, 10});
    const OverlayBox drawn = drawLegend(legend, kPicture);
    EXPECT_EQ(drawn.left, 10u);
    EXPECT_EQ(drawn.top + drawn.size.height, kPicture.height - 10);
    const Pixels picture = withLegend(legend);
    for (std::size_t y = 0; y < kPicture.height; ++y)
        for (std::size_t x = 0; x < kPicture.width; ++x) {
            const bool inside = x >= 10 && x < 10 + drawn.size.width && y >= drawn.top && y < kPicture.height - 10;
            if (!inside) {
                ASSERT_EQ(pixelAt(picture, x, y), (Srgb8{100, 100, 100})) << x << " " << y;
            }
        }
    const OverlayBox large = drawLegend(legend, {2048, 2048});
    EXPECT_EQ(large.size.width, 4 * drawn.size.width) << "letters scale with the picture";
}

TEST(LegendPicture, DoesNotDependOnHowRowsAreAdded) {
    const Legend legend = listLegend("classification", ColorMap::kClasses, std::vector<double>{2, 5, 6});
    const Pixels whole = withLegend(legend);
    const OverlayBox drawn = drawLegend(legend, kPicture);
    Pixels parts = greyPicture(kPicture);
    const std::size_t row = std::size_t{3} * kPicture.width;
    for (std::size_t first = 0; first < kPicture.height; first += 7) {
        const std::size_t rows = std::min<std::size_t>(7, kPicture.height - first);
        compositeBox(drawn, {std::span(parts).subspan(first * row, rows * row), kPicture.width, first});
    }
    EXPECT_EQ(parts, whole);
}

TEST(LegendPicture, IsCompositedWithStraightAlpha) {
    OverlayBox legend;
    legend.size = {4, 1};
    legend.rgba = {200, 0, 0, 255, 200, 0, 0, 51, 200, 0, 0, 51, 200, 0, 0, 0}; // 51: a fifth
    Pixels picture = {1, 2, 3, 0, 1, 2, 3, 0, 100, 50, 0, 255, 7, 8, 9, 0};
    compositeBox(legend, {picture, 4, 0, 4});
    EXPECT_EQ(picture, (Pixels{200, 0, 0, 255, 200, 0, 0, 51, 120, 40, 0, 255, 7, 8, 9, 0}));
}

TEST(LegendPicture, DrawsTheGlyphsOfTheFont) {
    Legend legend;
    legend.title = "I"; // a bar between two serifs in the font 6x13: rows 2 to 10, the bar in the third column
    const OverlayBox drawn = drawLegend(legend, {100, 100});
    const auto is_white = [&](std::size_t x, std::size_t y) {
        return drawn.rgba[4 * (y * drawn.size.width + x)] == 255;
    };
    const std::size_t left = 7, top = 7;
    EXPECT_FALSE(is_white(left + 2, top + 1));
    for (std::size_t y = 2; y <= 10; ++y) EXPECT_TRUE(is_white(left + 2, top + y)) << y;
    EXPECT_TRUE(is_white(left + 1, top + 2) && is_white(left + 3, top + 2) && is_white(left + 1, top + 10));
    EXPECT_FALSE(is_white(left + 1, top + 6) || is_white(left + 3, top + 6));
    EXPECT_FALSE(is_white(left + 2, top + 11));
}

TEST(LegendPicture, FitsAnyPictureAndAnyName) {
    Legend legend = barLegend(std::string(1000, 'x'), ColorMap::kTurbo, {-1e300, 1e300});
    legend.entries = {{"größe \x01\xff", {1, 2, 3}}};
    for (const PixelSize size : {PixelSize{1, 1}, PixelSize{3, 500}, PixelSize{500, 2}}) {
        Pixels picture = greyPicture(size);
        compositeBox(drawLegend(legend, size), {picture, size.width, 0});
    }
    EXPECT_LT(drawLegend(legend, kPicture).size.width, kPicture.width);
}

} // namespace
} // namespace pointrt

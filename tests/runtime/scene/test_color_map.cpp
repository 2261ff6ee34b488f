// SPDX-License-Identifier: Apache-2.0
// Colours of maps, compared with those published by their authors, and the numbers of legends.
#include "runtime/scene/color_map.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "runtime/scene/legend.h"
#include "runtime/scene/point_classes.h"

namespace pointrt {
namespace {

Srgb8 hex(std::uint32_t color) {
    return {static_cast<std::uint8_t>(color >> 16), static_cast<std::uint8_t>(color >> 8),
            static_cast<std::uint8_t>(color)};
}

void expectMap(ColorMap map, std::uint32_t low, std::uint32_t middle, std::uint32_t high) {
    const ColorScale scale(map, {-10, 30});
    EXPECT_EQ(scale(-10), hex(low)) << nameOf(kColorMapNames, map);
    EXPECT_EQ(scale(10), hex(middle)) << nameOf(kColorMapNames, map);
    EXPECT_EQ(scale(30), hex(high)) << nameOf(kColorMapNames, map);
    EXPECT_EQ(scale(-1e300), hex(low)) << "beyond the range";
    EXPECT_EQ(scale(31), hex(high));
}

TEST(ColorMap, HasThePublishedColours) {
    // the colours of matplotlib 3.11 for 0, 0.5 and 1
    expectMap(ColorMap::kViridis, 0x440154, 0x21918c, 0xfde725);
    expectMap(ColorMap::kMagma, 0x000004, 0xb73779, 0xfcfdbf);
    expectMap(ColorMap::kInferno, 0x000004, 0xbc3754, 0xfcffa4);
    expectMap(ColorMap::kPlasma, 0x0d0887, 0xcc4778, 0xf0f921);
    expectMap(ColorMap::kCividis, 0x00224e, 0x7d7c78, 0xfee838);
    expectMap(ColorMap::kTurbo, 0x30123b, 0xa4fc3c, 0x7a0403);
    expectMap(ColorMap::kGrey, 0x000000, 0x808080, 0xffffff);
}

TEST(ColorMap, MissingValuesAreGrey) {
    for (const auto& [name, map] : kColorMapNames) {
        const ColorScale scale(map, {0, 1});
        for (const double none :
             {std::nan(""), std::numeric_limits<double>::infinity(), -std::numeric_limits<double>::infinity()})
            EXPECT_EQ(scale(none), kMissingColor) << name;
    }
}

TEST(ColorMap, EmptyRangesHaveThreeColours) {
    const ColorScale scale(ColorMap::kGrey, {5, 5});
    EXPECT_EQ(scale(4.9), hex(0x000000));
    EXPECT_EQ(scale(5), hex(0x808080));
    EXPECT_EQ(scale(5.1), hex(0xffffff));
}

TEST(ColorMap, HasAColourForEachClass) {
    const ColorScale classes(ColorMap::kClasses, {});
    EXPECT_EQ(classes(6), classColor(6));
    EXPECT_EQ(classes(6.4), classColor(6));
    EXPECT_NE(classes(5), classes(6));
    EXPECT_EQ(classes(-1), kMissingColor);
    EXPECT_EQ(classes(256), kMissingColor);
    EXPECT_EQ(className(2), "ground");
    EXPECT_EQ(className(22), "temporal exclusion");
    EXPECT_EQ(className(23), "class 23");
}

TEST(ColorMap, ScanColoursRepeat) {
    const ColorScale scans(ColorMap::kScans, {});
    constexpr std::size_t kColors = 19; // of Kelly's 22 without white, black and grey
    EXPECT_EQ(scans.colors().size(), kColors);
    EXPECT_EQ(scans(0), hex(0xffb300));
    EXPECT_EQ(scans(kColors), scans(0));
    for (std::size_t i = 0; i < kColors; ++i)
        for (std::size_t k = 0; k < i; ++k) EXPECT_NE(scans.colors()[i], scans.colors()[k]);
    EXPECT_EQ(scans(1e300), kMissingColor);
}

std::string ticksText(ValueRange range) {
    std::string text;
    for (const LegendTick& tick : ticksOf(range)) text += (text.empty() ? "" : " ") + tick.text;
    return text;
}

TEST(Legend, HasRoundNumbers) {
    EXPECT_EQ(ticksText({0, 1}), "0.0 0.2 0.4 0.6 0.8 1.0");
    EXPECT_EQ(ticksText({407.2, 612.9}), "450 500 550 600");
    EXPECT_EQ(ticksText({-3e-4, 3e-4}), "-0.0003 -0.0002 -0.0001 0.0000 0.0001 0.0002 0.0003");
    EXPECT_EQ(ticksText({1e9, 1e9 + 7}), "1000000000 1000000002 1000000004 1000000006");
    EXPECT_EQ(ticksText({7, 7}), "7");
    const std::vector<LegendTick> ticks = ticksOf({0, 10});
    EXPECT_EQ(ticks.front().share, 0);
    EXPECT_EQ(ticks.back().share, 1);
    const double largest = std::numeric_limits<double>::max();
    for (const ValueRange range : {ValueRange{-largest, largest},
                                   {0, largest},
                                   {0, 5e-324},
                                   {1e308, 1.01e308},
                                   {1e16, 1e16 + 2},
                                   {-1e18, -1e18 + 128}})
        EXPECT_LE(ticksOf(range).size(), 13u) << range.low;
}

TEST(Legend, ListsValuesInUse) {
    const double classes[] = {2, 6, 64};
    const Legend legend = listLegend("classification", ColorMap::kClasses, classes);
    EXPECT_TRUE(legend.bar.empty());
    ASSERT_EQ(legend.entries.size(), 3u);
    EXPECT_EQ(legend.entries[0].text, "2 ground");
    EXPECT_EQ(legend.entries[1].color, classColor(6));
    EXPECT_EQ(legend.entries[2].text, "64 class 64");
    std::vector<double> many;
    for (int i = 0; i < 100; ++i) many.push_back(i);
    const Legend cut = listLegend("scan", ColorMap::kScans, many);
    EXPECT_EQ(cut.entries.size(), 17u);
    EXPECT_EQ(cut.entries.back().text, "... 84 more");
}

} // namespace
} // namespace pointrt

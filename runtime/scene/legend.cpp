// SPDX-License-Identifier: Apache-2.0
#include "runtime/scene/legend.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "runtime/scene/point_classes.h"

namespace pointrt {
namespace {

/// a longer list would cover the picture
constexpr std::size_t kMostEntries = 16;
constexpr double kMostTicks = 6;

/// The smallest step of 1, 2 or 5 times a power of ten that divides width into at most kMostTicks parts.
double stepFor(double width) {
    const double least = width / kMostTicks, power = std::pow(10.0, std::floor(std::log10(least)));
    for (const double factor : {1.0, 2.0, 5.0})
        if (factor * power >= least * (1 - 1e-9)) return factor * power; // tolerance for rounding
    return 10 * power;
}

/// Larger numbers are written with an exponent, since doubles have no more digits.
constexpr double kLongest = 1e15;

std::string tickText(double value, double step) {
    char text[40];
    const int decimals = std::clamp(static_cast<int>(std::ceil(-std::log10(step) - 1e-9)), 0, 12);
    if (std::abs(value) < kLongest)
        std::snprintf(text, sizeof text, "%.*f", decimals, value == 0 ? 0.0 : value); // never -0
    else
        std::snprintf(text, sizeof text, "%.6g", value);
    return text;
}

std::string oneNumber(double value) {
    char text[40];
    std::snprintf(text, sizeof text, "%.10g", value);
    return text;
}

std::string entryText(ColorMap map, double number) {
    const bool is_class = map == ColorMap::kClasses && number >= 0 && number < 256;
    return oneNumber(number) + (is_class ? " " + className(static_cast<std::uint8_t>(number)) : "");
}

} // namespace

std::vector<LegendTick> ticksOf(ValueRange range) {
    const double width = range.high - range.low;
    if (!(width > 0) || !std::isfinite(width)) return {{0.5, oneNumber(range.low)}};
    const double step = stepFor(width);
    std::vector<LegendTick> ticks;
    const double first = std::ceil(range.low / step - 1e-9);
    for (int k = 0; k <= 2 * kMostTicks && (first + k) * step <= range.high + 1e-9 * step; ++k) {
        const double value = (first + k) * step;
        const std::string text = tickText(value, step);
        // steps below the precision of large numbers give equal texts
        if (!ticks.empty() && ticks.back().text == text) continue;
        ticks.push_back({std::clamp((value - range.low) / width, 0.0, 1.0), text});
    }
    return ticks;
}

Legend barLegend(const std::string& title, ColorMap map, ValueRange range) {
    Legend legend;
    legend.title = title;
    legend.range = range;
    legend.bar = ColorScale(map, range).colors();
    legend.ticks = ticksOf(range);
    return legend;
}

Legend listLegend(const std::string& title, ColorMap map, std::span<const double> numbers) {
    Legend legend;
    legend.title = title;
    const ColorScale scale(map, {});
    const std::size_t shown = std::min(numbers.size(), kMostEntries);
    for (const double number : numbers.first(shown)) legend.entries.push_back({entryText(map, number), scale(number)});
    if (shown < numbers.size())
        legend.entries.push_back({"... " + std::to_string(numbers.size() - shown) + " more", kMissingColor});
    return legend;
}

} // namespace pointrt

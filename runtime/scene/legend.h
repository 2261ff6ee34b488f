// SPDX-License-Identifier: Apache-2.0
// What colours mean, for whoever looks at them.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "runtime/scene/color_map.h"

namespace pointrt {

struct LegendTick {
    double share; ///< of the bar, from its lowest number
    std::string text;
};

struct LegendEntry {
    std::string text;
    Srgb8 color;
};

/// A bar of colours with numbers beside it, or a list of colours.
struct Legend {
    std::string title;
    ValueRange range;       ///< of the bar
    std::vector<Srgb8> bar; ///< the lowest first; empty: a list
    std::vector<LegendTick> ticks;
    std::vector<LegendEntry> entries;
};

/// Of a map that is not categorical.
Legend barLegend(const std::string& title, ColorMap map, ValueRange range);

/// Of a categorical map, with the numbers that are there, in ascending order: the first of them where they are many.
Legend listLegend(const std::string& title, ColorMap map, std::span<const double> numbers);

/// Round numbers within range, a few: steps of 1, 2 or 5 times a power of ten, with no more decimals than that takes.
std::vector<LegendTick> ticksOf(ValueRange range);

} // namespace pointrt

// SPDX-License-Identifier: Apache-2.0
// Legends of colour maps, as data.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "runtime/scene/color_map.h"

namespace pointrt {

struct LegendTick {
    double share; ///< position on the bar, 0 to 1 from its lowest value
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
    std::vector<Srgb8> bar; ///< lowest value first; empty: the legend is a list
    std::vector<LegendTick> ticks;
    std::vector<LegendEntry> entries;
};

/// The legend of a continuous map.
Legend barLegend(const std::string& title, ColorMap map, ValueRange range);

/// The legend of a categorical map for the values in use, in ascending order; long lists are cut.
Legend listLegend(const std::string& title, ColorMap map, std::span<const double> numbers);

/// Round values within range, in steps of 1, 2 or 5 times a power of ten, with as many decimals as the step needs.
std::vector<LegendTick> ticksOf(ValueRange range);

} // namespace pointrt

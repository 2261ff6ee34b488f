// SPDX-License-Identifier: Apache-2.0
// Maps from numbers to colours.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "runtime/scene/value_range.h"
#include "runtime/util/names.h"

namespace pointrt {

/// sRGB.
using Srgb8 = std::array<std::uint8_t, 3>;

enum class ColorMap { kViridis, kMagma, kInferno, kPlasma, kCividis, kTurbo, kGrey, kClasses, kScans };
inline constexpr std::array kColorMapNames = {
    Name{"viridis", ColorMap::kViridis}, Name{"magma", ColorMap::kMagma},     Name{"inferno", ColorMap::kInferno},
    Name{"plasma", ColorMap::kPlasma},   Name{"cividis", ColorMap::kCividis}, Name{"turbo", ColorMap::kTurbo},
    Name{"grey", ColorMap::kGrey},       Name{"classes", ColorMap::kClasses}, Name{"scans", ColorMap::kScans}};

/// Of what has no number: NaN, infinite, or not said by its scan.
inline constexpr Srgb8 kMissingColor{128, 128, 128};

/// Whether the map has a colour for each whole number, and nothing between them.
constexpr bool isCategorical(ColorMap map) { return map == ColorMap::kClasses || map == ColorMap::kScans; }

/// A map over a range, to be asked many times.
class ColorScale {
public:
    /// range: of maps that are not categorical.
    ColorScale(ColorMap map, ValueRange range);

    /// What is beyond the range gets the colour of its end; of categorical maps the number is rounded, and one below 0
    /// is missing. kClasses goes to 255, kScans begins anew after its last.
    Srgb8 operator()(double value) const;

    /// All colours of a map that is not categorical, the lowest first.
    const std::vector<Srgb8>& colors() const { return colors_; }

private:
    ColorMap map_;
    std::vector<Srgb8> colors_; ///< 256, or those of the scans
    double low_, high_, steps_;
};

} // namespace pointrt

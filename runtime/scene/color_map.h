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

enum class ColorMap { kViridis, kMagma, kInferno, kPlasma, kCividis, kTurbo, kCoolwarm, kGrey, kClasses, kScans };
inline constexpr std::array kColorMapNames = {Name{"viridis", ColorMap::kViridis},   Name{"magma", ColorMap::kMagma},
                                              Name{"inferno", ColorMap::kInferno},   Name{"plasma", ColorMap::kPlasma},
                                              Name{"cividis", ColorMap::kCividis},   Name{"turbo", ColorMap::kTurbo},
                                              Name{"coolwarm", ColorMap::kCoolwarm}, Name{"grey", ColorMap::kGrey},
                                              Name{"classes", ColorMap::kClasses},   Name{"scans", ColorMap::kScans}};

/// The colour of splats whose value is NaN, infinite, or missing from their scan.
inline constexpr Srgb8 kMissingColor{128, 128, 128};

/// True if the map has a colour per integer and none in between.
constexpr bool isCategorical(ColorMap map) { return map == ColorMap::kClasses || map == ColorMap::kScans; }

/// True for diverging maps: the middle stands for 0, and lower and higher values differ in hue.
constexpr bool isDiverging(ColorMap map) { return map == ColorMap::kCoolwarm; }

/// A colour map over a range of values.
class ColorScale {
public:
    /// range: ignored by categorical maps.
    ColorScale(ColorMap map, ValueRange range);

    /// Values beyond the range get the colour of its end. Categorical maps round the value and treat negative ones as
    /// missing; kClasses ends at 255, kScans repeats its colours.
    Srgb8 operator()(double value) const;

    /// The colours of a continuous map, lowest value first.
    const std::vector<Srgb8>& colors() const { return colors_; }

private:
    ColorMap map_;
    std::vector<Srgb8> colors_; ///< 256, or the number of kScans
    double low_, high_, steps_;
};

} // namespace pointrt

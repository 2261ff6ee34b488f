// SPDX-License-Identifier: Apache-2.0
#include "runtime/scene/color_map.h"

#include <algorithm>
#include <cmath>
#include <string_view>

#include "runtime/scene/color_map_tables.h"
#include "runtime/scene/point_classes.h"

namespace pointrt {
namespace {

constexpr std::size_t kColorSteps = 256;

/// Kenneth L. Kelly, Twenty-two colors of maximum contrast, Color Engineering 3, 1965, as sRGB, without white, black
/// and grey, which marks missing values.
constexpr std::string_view kScanColors = "ffb300803e75ff6800a6bdd7c10020cea262007d34f6768e00538aff7a5c53377aff8e00"
                                         "b32851f4c8007f180d93aa00593315f13a13232c16";

std::uint8_t digit(char c) { return static_cast<std::uint8_t>(c <= '9' ? c - '0' : c - 'a' + 10); }

std::vector<Srgb8> colorsOf(std::string_view hex) {
    std::vector<Srgb8> colors(hex.size() / 6);
    for (std::size_t i = 0; i < 3 * colors.size(); ++i)
        colors[i / 3][i % 3] = static_cast<std::uint8_t>(16 * digit(hex[2 * i]) + digit(hex[2 * i + 1]));
    return colors;
}

template <typename ColorOf>
std::vector<Srgb8> colorsBy(const ColorOf& color_of) {
    std::vector<Srgb8> colors(kColorSteps);
    for (std::size_t i = 0; i < kColorSteps; ++i) colors[i] = color_of(static_cast<std::uint8_t>(i));
    return colors;
}

std::vector<Srgb8> colorsOf(ColorMap map) {
    switch (map) {
    case ColorMap::kViridis:
        return colorsOf(kViridis);
    case ColorMap::kMagma:
        return colorsOf(kMagma);
    case ColorMap::kInferno:
        return colorsOf(kInferno);
    case ColorMap::kPlasma:
        return colorsOf(kPlasma);
    case ColorMap::kCividis:
        return colorsOf(kCividis);
    case ColorMap::kTurbo:
        return colorsOf(kTurbo);
    case ColorMap::kCoolwarm:
        return colorsOf(kCoolwarm);
    case ColorMap::kGrey:
        return colorsBy([](std::uint8_t step) { return Srgb8{step, step, step}; });
    case ColorMap::kClasses:
        return colorsBy(classColor);
    case ColorMap::kScans:
        break;
    }
    return colorsOf(kScanColors);
}

} // namespace

ColorScale::ColorScale(ColorMap map, ValueRange range)
    : map_(map), colors_(colorsOf(map)), low_(range.low), high_(range.high),
      steps_(range.high > range.low ? kColorSteps / (range.high - range.low) : 0) {}

Srgb8 ColorScale::operator()(double value) const {
    if (!std::isfinite(value)) return kMissingColor;
    if (isCategorical(map_)) {
        const double whole = std::round(value);
        const bool is_there = whole >= 0 && (map_ == ColorMap::kScans ? whole < 0x1p53 : whole < kColorSteps);
        return is_there ? colors_[static_cast<std::uint64_t>(whole) % colors_.size()] : kMissingColor;
    }
    if (steps_ == 0) return colors_[value < low_ ? 0 : value > high_ ? kColorSteps - 1 : kColorSteps / 2];
    const double step = std::clamp((value - low_) * steps_, 0.0, double{kColorSteps - 1});
    return colors_[static_cast<std::size_t>(step)];
}

} // namespace pointrt

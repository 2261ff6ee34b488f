// SPDX-License-Identifier: GPL-3.0-or-later
// The sRGB curve (IEC 61966-2-1). Values are 0 to 1.
#pragma once

#include <cmath>

namespace pointrt {

inline double linearFromSrgb(double srgb) {
    return srgb <= 0.04045 ? srgb / 12.92 : std::pow((srgb + 0.055) / 1.055, 2.4);
}

inline double srgbFromLinear(double linear) {
    return linear <= 0.0031308 ? 12.92 * linear : 1.055 * std::pow(linear, 1 / 2.4) - 0.055;
}

/// The slope of the curve.
inline double srgbSlope(double linear) {
    return linear <= 0.0031308 ? 12.92 : 1.055 / 2.4 * std::pow(linear, 1 / 2.4 - 1);
}

} // namespace pointrt

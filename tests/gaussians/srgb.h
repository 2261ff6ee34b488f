// SPDX-License-Identifier: Apache-2.0
// The sRGB transfer function (IEC 61966-2-1); both functions are extended beyond 0 to 1 by the same formulas.
#pragma once

#include <cmath>

namespace pointrt::test {

inline double linearFromSrgb(double c) { return c <= 0.04045 ? c / 12.92 : std::pow((c + 0.055) / 1.055, 2.4); }
inline double srgbFromLinear(double c) { return c <= 0.0031308 ? c * 12.92 : 1.055 * std::pow(c, 1 / 2.4) - 0.055; }

} // namespace pointrt::test

// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cmath>
#include <cstdint>

namespace pointrt {

/// Linear RGB: reflectance in [0, 1], or light of at least 0.
using Color = std::array<float, 3>;

/// The inverse of the sRGB transfer function (IEC 61966-2-1).
inline float linearFromSrgb(std::uint8_t byte) {
    const float encoded = static_cast<float>(byte) / 255.0f;
    return encoded <= 0.04045f ? encoded / 12.92f : std::pow((encoded + 0.055f) / 1.055f, 2.4f);
}

} // namespace pointrt

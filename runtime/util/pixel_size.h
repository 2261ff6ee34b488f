// SPDX-License-Identifier: Apache-2.0
// How many pixels a picture or a window has.
#pragma once

#include <cstdint>

namespace pointrt {

/// The most on each side of any picture: what image viewers and GPUs take as a texture.
constexpr std::uint32_t kMaxPixelSide = 16384;

struct PixelSize {
    std::uint32_t width = 0, height = 0;
    bool operator==(const PixelSize&) const = default;
};

} // namespace pointrt

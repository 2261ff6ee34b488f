// SPDX-License-Identifier: Apache-2.0
// The size of a picture or window in pixels.
#pragma once

#include <cstdint>

namespace pointrt {

/// Limit for each side of a picture: what GPUs and image viewers support as a texture.
constexpr std::uint32_t kMaxPixelSide = 16384;

struct PixelSize {
    std::uint32_t width = 0, height = 0;
    bool operator==(const PixelSize&) const = default;
};

} // namespace pointrt

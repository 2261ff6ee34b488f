// SPDX-License-Identifier: Apache-2.0
// 8-bit sRGB pictures as PNG.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace pointrt {

/// An 8-bit sRGB picture: rows from the top, RGB or (with straight alpha) RGBA.
struct Image8 {
    std::uint32_t width = 0, height = 0;
    std::uint32_t channels = 4; ///< 3 or 4
    std::vector<std::uint8_t> pixels;
};

/// Writes image to path, all or nothing, with an sRGB chunk. Throws Error kCannotWrite "PATH: reason".
void writePng(const std::string& path, const Image8& image);

} // namespace pointrt

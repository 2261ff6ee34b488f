// SPDX-License-Identifier: Apache-2.0
// Legends drawn as pixels, for picture files.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "runtime/scene/legend.h"
#include "runtime/util/pixel_size.h"

namespace pointrt {

/// A rectangle of pixels to composite over a picture. Parts outside the picture are clipped.
struct LegendPicture {
    std::size_t left = 0, top = 0;
    PixelSize size;
    std::vector<std::uint8_t> rgba; ///< sRGB and opacity, rows from the top
};

/// Draws a legend for the lower left corner of a picture of this size, scaled with it.
LegendPicture drawLegend(const Legend& legend, PixelSize picture);

/// Complete rows of a picture.
struct PictureRows {
    std::span<std::uint8_t> pixels;
    std::size_t width = 1; ///< pixels
    std::size_t first_row = 0;
    std::size_t channels = 3; ///< 3: RGB, 4: RGBA with straight alpha
};

void compositeLegend(const LegendPicture& legend, const PictureRows& picture);

} // namespace pointrt

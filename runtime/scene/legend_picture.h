// SPDX-License-Identifier: Apache-2.0
// A legend as pixels, for pictures in files.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "runtime/scene/legend.h"
#include "runtime/util/pixel_size.h"

namespace pointrt {

/// Lies on a picture; what reaches out of it is not seen.
struct LegendPicture {
    std::size_t left = 0, top = 0;
    PixelSize size;
    std::vector<std::uint8_t> rgba; ///< sRGB and opacity, rows from the top
};

/// For the lower left corner of a picture of this size, in letters that are larger in larger pictures.
LegendPicture drawLegend(const Legend& legend, PixelSize picture);

/// Whole rows of a picture.
struct PictureRows {
    std::span<std::uint8_t> rgb;
    std::size_t width = 1; ///< pixels
    std::size_t first_row = 0;
};

void layOn(const LegendPicture& legend, const PictureRows& picture);

} // namespace pointrt

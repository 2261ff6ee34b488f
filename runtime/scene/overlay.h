// SPDX-License-Identifier: Apache-2.0
// Graphics to draw over a finished picture: lines, and boxes such as legends and labels.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "runtime/scene/color_map.h"
#include "runtime/util/pixel_size.h"

namespace pointrt {

/// A rectangle of pixels to composite over a picture. Parts outside the picture are clipped.
struct OverlayBox {
    std::size_t left = 0, top = 0;
    PixelSize size;
    std::vector<std::uint8_t> rgba; ///< sRGB and opacity, rows from the top
};

/// A place in a picture, in pixels from its upper left corner.
struct PixelPlace {
    double x = 0, y = 0;
};

/// A line with round ends, smoothed; a dot if both ends are equal. Parts outside the picture are clipped.
struct OverlayLine {
    PixelPlace from, to;
    double half_width = 1; ///< pixels
    Srgb8 color{255, 255, 255};
    double opacity = 1; ///< 0 to 1
};

/// Lines are below boxes, and later ones over earlier ones.
struct PictureOverlay {
    std::vector<OverlayLine> lines;
    std::vector<OverlayBox> boxes;
};

/// Complete rows of a picture.
struct PictureRows {
    std::span<std::uint8_t> pixels;
    std::size_t width = 1; ///< pixels
    std::size_t first_row = 0;
    std::size_t channels = 3; ///< 3: RGB, 4: RGBA with straight alpha
};

void compositeBox(const OverlayBox& box, const PictureRows& picture);
void compositeOverlay(const PictureOverlay& overlay, const PictureRows& picture);

/// Pixels per unit of a layout that is designed for pictures of about 512 pixels: a whole number, so that letters stay
/// sharp.
std::size_t overlayScale(PixelSize picture);

} // namespace pointrt

// SPDX-License-Identifier: Apache-2.0
// Draws rectangles and letters into a box over a picture.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>

#include "runtime/scene/overlay.h"

namespace pointrt {

/// Places and sizes are in units of a layout.
struct BoxPen {
    OverlayBox& box;
    std::size_t scale; ///< pixels per unit

    void fill(std::size_t left, std::size_t top, std::size_t width, std::size_t height, Srgb8 color) const;
    /// Sets a pixel of the box.
    void put(std::size_t x, std::size_t y, Srgb8 color) const;
    /// Writes white letters of the font, kGlyphWidth x kGlyphHeight units each.
    void write(std::size_t left, std::size_t top, std::string_view text) const;
};

/// A dark, translucent box of this size in units.
OverlayBox darkBox(std::size_t width, std::size_t height, std::size_t scale);

/// text as the font can show it: missing characters become ?, and text of more than 32 characters ends in "...".
std::string writable(std::string_view text);
/// Width of text as writable() leaves it, in units.
std::size_t widthOf(std::string_view text);

} // namespace pointrt

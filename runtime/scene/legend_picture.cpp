// SPDX-License-Identifier: Apache-2.0
#include "runtime/scene/legend_picture.h"

#include <algorithm>
#include <cmath>
#include <string>

#include "runtime/scene/box_pen.h"
#include "runtime/scene/small_font_glyphs.h"

namespace pointrt {
namespace {

// The layout, in units.
constexpr std::size_t kMargin = 10, kPadding = 7, kGap = 6, kLine = kGlyphHeight + 2;
constexpr std::size_t kBarWidth = 16, kBarHeight = 160, kTickWidth = 4, kSwatch = 10;

std::size_t innerWidth(const Legend& legend) {
    std::size_t width = widthOf(legend.title);
    for (const LegendTick& tick : legend.ticks)
        width = std::max(width, kBarWidth + kTickWidth + kGap / 2 + widthOf(tick.text));
    for (const LegendEntry& entry : legend.entries) width = std::max(width, kSwatch + kGap + widthOf(entry.text));
    return width;
}

/// Includes half a line above and below the bar, for the ticks at its ends.
std::size_t innerHeight(const Legend& legend) {
    return kLine + kGap + (legend.bar.empty() ? kLine * legend.entries.size() : kBarHeight + kLine);
}

void drawBar(const BoxPen& pen, const Legend& legend, std::size_t top) {
    const std::size_t rows = kBarHeight * pen.scale;
    for (std::size_t y = 0; y < rows; ++y) {
        const Srgb8 color = legend.bar[(rows - 1 - y) * legend.bar.size() / rows];
        for (std::size_t x = 0; x < kBarWidth * pen.scale; ++x)
            pen.put(kPadding * pen.scale + x, top * pen.scale + y, color);
    }
    for (const LegendTick& tick : legend.ticks) {
        const auto y = top + static_cast<std::size_t>(std::lround((1 - tick.share) * (kBarHeight - 1)));
        pen.fill(kPadding + kBarWidth, y, kTickWidth, 1, {255, 255, 255});
        pen.write(kPadding + kBarWidth + kTickWidth + kGap / 2, y - kGlyphHeight / 2, writable(tick.text));
    }
}

void drawEntries(const BoxPen& pen, const Legend& legend, std::size_t top) {
    for (const LegendEntry& entry : legend.entries) {
        pen.fill(kPadding, top + (kGlyphHeight - kSwatch) / 2, kSwatch, kSwatch, entry.color);
        pen.write(kPadding + kSwatch + kGap, top, writable(entry.text));
        top += kLine;
    }
}

} // namespace

OverlayBox drawLegend(const Legend& legend, PixelSize picture) {
    const std::size_t scale = overlayScale(picture);
    OverlayBox drawn = darkBox(innerWidth(legend) + 2 * kPadding, innerHeight(legend) + 2 * kPadding, scale);
    drawn.left = kMargin * scale;
    const std::size_t below = drawn.size.height + kMargin * scale;
    drawn.top = picture.height > below ? picture.height - below : 0;
    const BoxPen pen{drawn, scale};
    pen.write(kPadding, kPadding, writable(legend.title));
    const std::size_t top = kPadding + kLine + kGap;
    if (legend.bar.empty())
        drawEntries(pen, legend, top);
    else
        drawBar(pen, legend, top + kLine / 2);
    return drawn;
}

} // namespace pointrt

// SPDX-License-Identifier: Apache-2.0
#include "runtime/scene/legend_picture.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <string_view>

#include "runtime/scene/small_font_glyphs.h"

namespace pointrt {
namespace {

// The layout, in pixels of a picture of about kDesignSide pixels.
constexpr std::size_t kDesignSide = 512;
constexpr std::size_t kMargin = 10, kPadding = 7, kGap = 6, kLine = kGlyphHeight + 2;
constexpr std::size_t kBarWidth = 16, kBarHeight = 160, kTickWidth = 4, kSwatch = 10;
constexpr std::size_t kMostLetters = 32;
constexpr std::uint8_t kBackOpacity = 165;

struct Pen {
    LegendPicture& picture;
    std::size_t scale; ///< pixels per layout unit

    void fill(std::size_t left, std::size_t top, std::size_t width, std::size_t height, Srgb8 color) const {
        for (std::size_t y = top * scale; y < (top + height) * scale && y < picture.size.height; ++y)
            for (std::size_t x = left * scale; x < (left + width) * scale && x < picture.size.width; ++x)
                put(x, y, color);
    }

    void put(std::size_t x, std::size_t y, Srgb8 color) const {
        std::uint8_t* pixel = &picture.rgba[4 * (y * picture.size.width + x)];
        std::copy(color.begin(), color.end(), pixel);
        pixel[3] = 255;
    }

    void write(std::size_t left, std::size_t top, std::string_view text) const {
        for (const char letter : text) {
            writeLetter(left, top, letter);
            left += kGlyphWidth;
        }
    }

    void writeLetter(std::size_t left, std::size_t top, char letter) const {
        const char* rows = kGlyphs + 2 * kGlyphHeight * (letter - kFirstGlyph);
        const auto bits = [](char c) { return c <= '9' ? c - '0' : c - 'a' + 10; };
        for (std::size_t y = 0; y < kGlyphHeight; ++y) {
            const int row = 16 * bits(rows[2 * y]) + bits(rows[2 * y + 1]);
            for (std::size_t x = 0; x < kGlyphWidth; ++x)
                if (row >> (kGlyphWidth - 1 - x) & 1) fill(left + x, top + y, 1, 1, {255, 255, 255});
        }
    }
};

/// text in characters of the font: other UTF-8 characters become ?, and long text ends in dots.
std::string writable(std::string_view text) {
    std::string letters;
    for (const char c : text) {
        const bool is_continuation = (static_cast<unsigned char>(c) & 0xC0) == 0x80; // byte of a UTF-8 character
        if (!is_continuation) letters += c >= kFirstGlyph && c <= kLastGlyph ? c : '?';
    }
    if (letters.size() > kMostLetters) letters.replace(kMostLetters - 3, std::string::npos, "...");
    return letters;
}

std::size_t widthOf(const std::string& text) { return kGlyphWidth * writable(text).size(); }

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

void drawBar(const Pen& pen, const Legend& legend, std::size_t top) {
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

void drawEntries(const Pen& pen, const Legend& legend, std::size_t top) {
    for (const LegendEntry& entry : legend.entries) {
        pen.fill(kPadding, top + (kGlyphHeight - kSwatch) / 2, kSwatch, kSwatch, entry.color);
        pen.write(kPadding + kSwatch + kGap, top, writable(entry.text));
        top += kLine;
    }
}

/// Composites a pixel over one of a picture. Both have straight alpha; without it, the picture is opaque.
void compositePixel(const std::uint8_t* over, std::uint8_t* under, std::size_t channels) {
    const std::uint32_t alpha = channels == 4 ? under[3] : 255u;
    const std::uint32_t over_weight = 255u * over[3], under_weight = alpha * (255u - over[3]);
    const std::uint32_t sum = over_weight + under_weight; // of 255 * 255
    if (sum == 0) return;
    for (int c = 0; c < 3; ++c)
        under[c] = static_cast<std::uint8_t>((over[c] * over_weight + under[c] * under_weight + sum / 2) / sum);
    if (channels == 4) under[3] = static_cast<std::uint8_t>((sum + 127) / 255);
}

} // namespace

LegendPicture drawLegend(const Legend& legend, PixelSize picture) {
    const std::size_t side = std::min(picture.width, picture.height);
    const std::size_t scale = std::max<std::size_t>(1, (side + kDesignSide / 2) / kDesignSide);
    LegendPicture drawn;
    drawn.size = {static_cast<std::uint32_t>(scale * (innerWidth(legend) + 2 * kPadding)),
                  static_cast<std::uint32_t>(scale * (innerHeight(legend) + 2 * kPadding))};
    drawn.left = kMargin * scale;
    const std::size_t below = drawn.size.height + kMargin * scale;
    drawn.top = picture.height > below ? picture.height - below : 0;
    drawn.rgba.assign(std::size_t{4} * drawn.size.width * drawn.size.height, 0);
    for (std::size_t i = 3; i < drawn.rgba.size(); i += 4) drawn.rgba[i] = kBackOpacity;
    const Pen pen{drawn, scale};
    pen.write(kPadding, kPadding, writable(legend.title));
    const std::size_t top = kPadding + kLine + kGap;
    if (legend.bar.empty())
        drawEntries(pen, legend, top);
    else
        drawBar(pen, legend, top + kLine / 2);
    return drawn;
}

void compositeLegend(const LegendPicture& legend, const PictureRows& picture) {
    const std::size_t rows = picture.pixels.size() / (picture.channels * picture.width);
    const std::size_t bottom = std::min(legend.top + legend.size.height, picture.first_row + rows);
    const std::size_t right = std::min(legend.left + legend.size.width, picture.width);
    for (std::size_t y = std::max(legend.top, picture.first_row); y < bottom; ++y)
        for (std::size_t x = legend.left; x < right; ++x) {
            const std::uint8_t* over = &legend.rgba[4 * ((y - legend.top) * legend.size.width + x - legend.left)];
            const std::size_t pixel = (y - picture.first_row) * picture.width + x;
            compositePixel(over, &picture.pixels[picture.channels * pixel], picture.channels);
        }
}

} // namespace pointrt

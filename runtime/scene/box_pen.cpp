// SPDX-License-Identifier: Apache-2.0
#include "runtime/scene/box_pen.h"

#include <algorithm>

#include "runtime/scene/small_font_glyphs.h"

namespace pointrt {
namespace {

constexpr std::size_t kMostLetters = 32;
constexpr std::uint8_t kBackOpacity = 165;
constexpr Srgb8 kWhite = {255, 255, 255};

void writeLetter(const BoxPen& pen, std::size_t left, std::size_t top, char letter) {
    const char* rows = kGlyphs + 2 * kGlyphHeight * (letter - kFirstGlyph);
    const auto bits = [](char c) { return c <= '9' ? c - '0' : c - 'a' + 10; };
    for (std::size_t y = 0; y < kGlyphHeight; ++y) {
        const int row = 16 * bits(rows[2 * y]) + bits(rows[2 * y + 1]);
        for (std::size_t x = 0; x < kGlyphWidth; ++x)
            if (row >> (kGlyphWidth - 1 - x) & 1) pen.fill(left + x, top + y, 1, 1, kWhite);
    }
}

} // namespace

void BoxPen::fill(std::size_t left, std::size_t top, std::size_t width, std::size_t height, Srgb8 color) const {
    for (std::size_t y = top * scale; y < (top + height) * scale && y < box.size.height; ++y)
        for (std::size_t x = left * scale; x < (left + width) * scale && x < box.size.width; ++x) put(x, y, color);
}

void BoxPen::put(std::size_t x, std::size_t y, Srgb8 color) const {
    std::uint8_t* pixel = &box.rgba[4 * (y * box.size.width + x)];
    std::copy(color.begin(), color.end(), pixel);
    pixel[3] = 255;
}

void BoxPen::write(std::size_t left, std::size_t top, std::string_view text) const {
    for (const char letter : text) {
        writeLetter(*this, left, top, letter);
        left += kGlyphWidth;
    }
}

OverlayBox darkBox(std::size_t width, std::size_t height, std::size_t scale) {
    OverlayBox box;
    box.size = {static_cast<std::uint32_t>(scale * width), static_cast<std::uint32_t>(scale * height)};
    box.rgba.assign(std::size_t{4} * box.size.width * box.size.height, 0);
    for (std::size_t i = 3; i < box.rgba.size(); i += 4) box.rgba[i] = kBackOpacity;
    return box;
}

std::string writable(std::string_view text) {
    std::string letters;
    for (const char c : text) {
        // continuation byte of a UTF-8 character
        const bool is_continuation = (static_cast<unsigned char>(c) & 0xC0) == 0x80;
        if (!is_continuation) letters += c >= kFirstGlyph && c <= kLastGlyph ? c : '?';
    }
    if (letters.size() > kMostLetters) letters.replace(kMostLetters - 3, std::string::npos, "...");
    return letters;
}

std::size_t widthOf(std::string_view text) { return kGlyphWidth * writable(text).size(); }

} // namespace pointrt

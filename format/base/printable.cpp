// SPDX-License-Identifier: Apache-2.0
#include "format/base/printable.h"

#include <algorithm>
#include <array>
#include <cstdint>

namespace pointrt {

namespace {

/// A UTF-8 character: its code point and length; 0 bytes if invalid.
struct Character {
    std::uint32_t code = 0;
    std::size_t bytes = 0;
};

/// Unicode 15, table 3-7: no surrogates, no overlong sequences.
Character firstCharacter(std::string_view text) {
    const auto byte = [&](std::size_t i) { return static_cast<std::uint32_t>(static_cast<unsigned char>(text[i])); };
    const std::uint32_t lead = byte(0);
    if (lead < 0x80) return {lead, 1};
    const std::size_t bytes = lead >= 0xF0 ? 4 : lead >= 0xE0 ? 3 : 2;
    if (lead < 0xC2 || lead > 0xF4 || text.size() < bytes) return {};
    std::uint32_t code = lead & (0xFFu >> (bytes + 1));
    for (std::size_t i = 1; i < bytes; ++i) {
        if ((byte(i) & 0xC0) != 0x80) return {};
        code = code << 6 | (byte(i) & 0x3F);
    }
    constexpr std::array<std::uint32_t, 5> kLeast{0, 0, 0x80, 0x800, 0x10000};
    if (code < kLeast[bytes] || code > 0x10FFFF || (code >= 0xD800 && code <= 0xDFFF)) return {};
    return {code, bytes};
}

/// Control characters of ASCII and Latin-1, and invisible Unicode characters: zero width, line and paragraph
/// separators, direction marks and overrides, tags.
bool isHidden(std::uint32_t code) {
    struct Range {
        std::uint32_t first, last;
    };
    static constexpr Range kHidden[] = {{0, 0x1F},        {0x7F, 0x9F},      {0xAD, 0xAD},     {0x61C, 0x61C},
                                        {0x200B, 0x200F}, {0x2028, 0x202E},  {0x2060, 0x206F}, {0xFEFF, 0xFEFF},
                                        {0xFFF9, 0xFFFB}, {0xE0000, 0xE0FFF}};
    return std::any_of(std::begin(kHidden), std::end(kHidden),
                       [&](const Range& range) { return code >= range.first && code <= range.last; });
}

void appendEscaped(std::string& shown, char byte) {
    constexpr const char* kDigits = "0123456789abcdef";
    switch (byte) {
    case '\n':
        shown += "\\n";
        break;
    case '\t':
        shown += "\\t";
        break;
    case '\r':
        shown += "\\r";
        break;
    default: {
        const auto value = static_cast<unsigned char>(byte);
        shown += {'\\', 'x', kDigits[value >> 4], kDigits[value & 15]};
    }
    }
}

} // namespace

std::string printable(std::string_view text, std::size_t longest) {
    std::string shown;
    std::size_t at = 0;
    while (at < text.size()) {
        const Character character = firstCharacter(text.substr(at));
        const std::size_t bytes = std::max<std::size_t>(character.bytes, 1);
        if (at + bytes > longest) return shown + "...";
        if (character.bytes > 0 && !isHidden(character.code))
            shown += text.substr(at, bytes);
        else
            for (const char byte : text.substr(at, bytes)) appendEscaped(shown, byte);
        at += bytes;
    }
    return shown;
}

} // namespace pointrt

// SPDX-License-Identifier: GPL-3.0-or-later
// Morton codes of 63 bits: x in bit 0, y in bit 1, z in bit 2 of each triple.
#pragma once

#include <cstdint>

namespace pointrt {

constexpr int kMortonBits = 21; ///< per axis

/// Spreads the low 21 bits of v to every third bit.
constexpr std::uint64_t spreadBits(std::uint64_t v) {
    v &= 0x1FFFFFu;
    v = (v | v << 32) & 0x001F00000000FFFFu;
    v = (v | v << 16) & 0x001F0000FF0000FFu;
    v = (v | v << 8) & 0x100F00F00F00F00Fu;
    v = (v | v << 4) & 0x10C30C30C30C30C3u;
    return (v | v << 2) & 0x1249249249249249u;
}

/// Collects every third bit of v into 21 bits; the inverse of spreadBits.
constexpr std::uint32_t collectBits(std::uint64_t v) {
    v &= 0x1249249249249249u;
    v = (v | v >> 2) & 0x10C30C30C30C30C3u;
    v = (v | v >> 4) & 0x100F00F00F00F00Fu;
    v = (v | v >> 8) & 0x001F0000FF0000FFu;
    v = (v | v >> 16) & 0x001F00000000FFFFu;
    return static_cast<std::uint32_t>((v | v >> 32) & 0x1FFFFFu);
}

constexpr std::uint64_t mortonCode(std::uint64_t x, std::uint64_t y, std::uint64_t z) {
    return spreadBits(x) | spreadBits(y) << 1 | spreadBits(z) << 2;
}

} // namespace pointrt

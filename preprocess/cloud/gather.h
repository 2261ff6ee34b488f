// SPDX-License-Identifier: GPL-3.0-or-later
// Copies array elements by index.
#pragma once

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <span>

namespace pointrt {

template <std::size_t kSize>
void gatherFixed(const char* from, std::span<const std::uint32_t> indices, char* to) {
    for (std::size_t i = 0; i < indices.size(); ++i)
        std::memcpy(to + i * kSize, from + std::size_t{indices[i]} * kSize, kSize);
}

/// Copies the elements with these indices, of size bytes each, to consecutive elements of to.
inline void gatherValues(const char* from, std::size_t size, std::span<const std::uint32_t> indices, char* to) {
    switch (size) { // frequent sizes, for which the compiler inlines memcpy
    case 1:
        return gatherFixed<1>(from, indices, to);
    case 2:
        return gatherFixed<2>(from, indices, to);
    case 4:
        return gatherFixed<4>(from, indices, to);
    case 8:
        return gatherFixed<8>(from, indices, to);
    default:
        for (std::size_t i = 0; i < indices.size(); ++i) std::memcpy(to + i * size, from + indices[i] * size, size);
    }
}

} // namespace pointrt

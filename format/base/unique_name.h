// SPDX-License-Identifier: Apache-2.0
// Unique names of limited length.
#pragma once

#include <cstddef>
#include <string>

namespace pointrt {

/// UTF-8 text truncated to at most this many bytes, at a character boundary.
inline std::string cutTo(std::string text, std::size_t bytes) {
    if (text.size() <= bytes) return text;
    while (bytes > 0 && (static_cast<unsigned char>(text[bytes]) & 0xC0) == 0x80)
        --bytes; // 10xxxxxx: continuation bytes
    text.resize(bytes);
    return text;
}

/// name truncated to this many bytes, or the first of NAME_2, NAME_3 ... for which isTaken is false.
template <typename IsTaken>
std::string uniqueName(const std::string& name, std::size_t bytes, const IsTaken& isTaken) {
    std::string unique = cutTo(name, bytes);
    for (int number = 2; isTaken(unique); ++number) {
        const std::string suffix = "_" + std::to_string(number);
        unique = cutTo(name, bytes - suffix.size()) + suffix;
    }
    return unique;
}

} // namespace pointrt

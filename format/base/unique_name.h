// SPDX-License-Identifier: Apache-2.0
// Names that fit into a field and that no other has.
#pragma once

#include <cstddef>
#include <string>

namespace pointrt {

/// Of a UTF-8 text at most so many bytes, without half a character at their end.
inline std::string cutTo(std::string text, std::size_t bytes) {
    if (text.size() <= bytes) return text;
    while (bytes > 0 && (static_cast<unsigned char>(text[bytes]) & 0xC0) == 0x80) --bytes; // 10xxxxxx continue one
    text.resize(bytes);
    return text;
}

/// name cut to so many bytes or, where isTaken(that) holds, the first of NAME_2, NAME_3 ... of which it does not.
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

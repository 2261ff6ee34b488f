// SPDX-License-Identifier: Apache-2.0
// Internal to format/set: values of set.json for reading and writing.
#pragma once

#include <charconv>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

namespace pointrt {

constexpr const char* kSetFormat = "pointrt tile set";

constexpr std::size_t kChecksumDigits = 16; // 64 bits

/// Checksums are 16 hexadecimal digits, because most JSON readers store numbers as doubles.
inline std::string checksumWord(std::uint64_t checksum) {
    constexpr const char* kDigits = "0123456789abcdef";
    std::string word(kChecksumDigits, '0');
    for (std::size_t i = kChecksumDigits; i-- > 0; checksum >>= 4) word[i] = kDigits[checksum & 15];
    return word;
}

inline std::optional<std::uint64_t> checksumOfWord(std::string_view word) {
    std::uint64_t checksum = 0;
    const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), checksum, 16);
    const bool is_complete = error == std::errc() && end == word.data() + word.size() && word.size() == kChecksumDigits;
    return is_complete ? std::optional(checksum) : std::nullopt;
}

} // namespace pointrt

// SPDX-License-Identifier: Apache-2.0
// Names of temporary files: PATH.tmp-XXXXXXXX.
#pragma once

#include <random>
#include <string>
#include <string_view>

namespace pointrt::format {

inline constexpr std::size_t kRandomLetters = 8; // 41 bits
inline constexpr std::string_view kLetters = "abcdefghijklmnopqrstuvwxyz0123456789";

inline std::string temporaryStem(const std::string& path) { return path + ".tmp-"; }

inline std::string randomLetters() {
    std::random_device device;
    std::uniform_int_distribution<std::size_t> letter(0, kLetters.size() - 1);
    std::string word;
    for (std::size_t i = 0; i < kRandomLetters; ++i) word += kLetters[letter(device)];
    return word;
}

/// Whether name is a temporary name with this stem.
inline bool isTemporary(std::string_view name, std::string_view stem) {
    if (!name.starts_with(stem)) return false;
    const std::string_view word = name.substr(stem.size());
    return word.size() == kRandomLetters && word.find_first_not_of(kLetters) == word.npos;
}

} // namespace pointrt::format

// SPDX-License-Identifier: Apache-2.0
// The separators between folders in paths.
#pragma once

#include <filesystem>
#include <string_view>

namespace pointrt {

/// / and, on Windows, also the backslash.
inline constexpr std::string_view kFolderSeparators =
    std::filesystem::path::preferred_separator == '/' ? std::string_view("/") : std::string_view("/\\");

inline constexpr bool isFolderSeparator(char letter) {
    return kFolderSeparators.find(letter) != std::string_view::npos;
}

} // namespace pointrt

// SPDX-License-Identifier: Apache-2.0
// Keeps outputs from overwriting inputs.
#pragma once

#include <filesystem>
#include <string>
#include <system_error>

namespace pointrt {

/// Whether two paths lead to one file, through any links. The file need not exist.
inline bool isSameFile(const std::string& a, const std::string& b) {
    std::error_code ignored;
    return std::filesystem::equivalent(a, b, ignored) ||
           std::filesystem::weakly_canonical(a, ignored) == std::filesystem::weakly_canonical(b, ignored);
}

} // namespace pointrt

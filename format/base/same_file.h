// SPDX-License-Identifier: Apache-2.0
// So that nothing that is written lands on what is read.
#pragma once

#include <filesystem>
#include <string>
#include <system_error>

namespace pointrt {

/// Whether two paths name one file, by whatever links; also where it is not there yet.
inline bool isSameFile(const std::string& a, const std::string& b) {
    std::error_code ignored;
    return std::filesystem::equivalent(a, b, ignored) ||
           std::filesystem::weakly_canonical(a, ignored) == std::filesystem::weakly_canonical(b, ignored);
}

} // namespace pointrt

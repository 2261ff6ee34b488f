// SPDX-License-Identifier: Apache-2.0
// A whole file in memory, for the small readers of pictures.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace pointrt {

/// The bytes of path, followed by padding zeros. Throws Error kBadInput "PATH: reason".
std::vector<std::uint8_t> readFileBytes(const std::string& path, std::size_t padding = 0);

} // namespace pointrt

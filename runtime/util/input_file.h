// SPDX-License-Identifier: Apache-2.0
// A whole file in memory, for the small readers of pictures.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace pointrt {

/// The bytes of path, followed by padding zeros. Throws Error kBadInput "PATH: reason", at once where path is no
/// regular file: a pipe that nobody writes to would be waited for for ever.
std::vector<std::uint8_t> readFileBytes(const std::string& path, std::size_t padding = 0);

/// The first `most` bytes of path, or all where it has fewer. Throws as readFileBytes does.
std::vector<std::uint8_t> readFileStart(const std::string& path, std::size_t most);

} // namespace pointrt

// SPDX-License-Identifier: Apache-2.0
// Reads whole files into memory.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace pointrt {

/// The bytes of path, followed by padding zeros. Throws Error kBadInput "PATH: reason", also if path is not a regular
/// file: reading a pipe without a writer would block forever.
std::vector<std::uint8_t> readFileBytes(const std::string& path, std::size_t padding = 0);

/// The first `most` bytes of path, or all if it has fewer. Throws as readFileBytes does.
std::vector<std::uint8_t> readFileStart(const std::string& path, std::size_t most);

} // namespace pointrt

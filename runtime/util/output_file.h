// SPDX-License-Identifier: Apache-2.0
// Files that appear whole or not at all, with the errors of the tools.
#pragma once

#include <cstdint>
#include <span>
#include <string>

namespace pointrt {

/// Writes bytes to path, replacing what is there; a failure leaves what was there.
/// Throws Error kCannotWrite "PATH: reason".
void writeFile(const std::string& path, std::span<const std::uint8_t> bytes);

/// Throws Error kCannotWrite where writeFile is sure to fail: the folder is missing or read-only, or path is no file.
/// To be asked before long work.
void requireWritable(const std::string& path);

} // namespace pointrt

// SPDX-License-Identifier: Apache-2.0
// Mutates .pro files, and repairs sizes, the section table and checksums, without which they would be refused at once.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <random>
#include <vector>

namespace pointrt::fuzz {

/// Changes the first `size` bytes of a block with room for `most` in place, and returns the new size.
using ChangeBytes = std::function<std::size_t(std::uint8_t* data, std::size_t size, std::size_t most)>;

/// A mutant of a .pro file: changes a section, header fields or the table, and usually repairs the rest. Files that are
/// not .pro are changed as plain bytes.
/// @param most largest size in bytes
std::vector<std::uint8_t> mutatePro(std::vector<std::uint8_t> file, std::size_t most, std::mt19937& random,
                                    const ChangeBytes& change);

} // namespace pointrt::fuzz

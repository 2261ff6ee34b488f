// SPDX-License-Identifier: Apache-2.0
// Changes .pro files where it hurts, and repairs what would have them refused at once: sizes, the section table, the
// checksums.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <random>
#include <vector>

namespace pointrt::fuzz {

/// Changes bytes in place: of the first `size` of a block that has room for `most`, returns how many there are then.
using ChangeBytes = std::function<std::size_t(std::uint8_t* data, std::size_t size, std::size_t most)>;

/// A mutant of a .pro file: a section, the header's fields or the table changed, and most often the rest repaired.
/// What is no .pro file at all is changed as any bytes are.
/// @param most bytes that it may have
std::vector<std::uint8_t> mutatePro(std::vector<std::uint8_t> file, std::size_t most, std::mt19937& random,
                                    const ChangeBytes& change);

} // namespace pointrt::fuzz

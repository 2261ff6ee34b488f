// SPDX-License-Identifier: GPL-3.0-or-later
// The compression of binary_compressed PCD files.
#pragma once

#include <string>
#include <string_view>

namespace pointrt {

/// The most bytes that one compressed byte can stand for: a back reference of 3 bytes copies up to 264.
constexpr std::size_t kLargestLzfGain = 264 / 3;

/// Unpacks LZF data (Marc Lehmann's liblzf format) of which the unpacked size is known.
/// False when the data is broken or gives another size. Reads and writes within bounds whatever the data.
bool unpackLzf(std::string_view packed, std::size_t unpacked_size, std::string& unpacked);

} // namespace pointrt

// SPDX-License-Identifier: GPL-3.0-or-later
// The compression of binary_compressed PCD files.
#pragma once

#include <string>
#include <string_view>

namespace pointrt {

/// The most bytes that one compressed byte can expand to: a back reference of 3 bytes copies up to 264.
constexpr std::size_t kLargestLzfGain = 264 / 3;

/// Unpacks LZF data (Marc Lehmann's liblzf format) of known unpacked size. Returns false if the data is invalid,
/// truncated or has another size; the data before the fault is unpacked. Reads and writes stay within bounds for any
/// data, and memory within kLargestLzfGain times its size.
bool unpackLzf(std::string_view packed, std::size_t unpacked_size, std::string& unpacked);

} // namespace pointrt

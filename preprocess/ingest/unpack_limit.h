// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>

namespace pointrt {

/// The largest unpacked size of compressed data: 64 MiB plus 100 times the packed size. Scans compress about ten times,
/// and flat ground a hundred; deflate expands a byte to as many as 1032, zstd to more.
constexpr std::uint64_t mostUnpacked(std::uint64_t packed) { return (std::uint64_t{64} << 20) + 100 * packed; }

} // namespace pointrt

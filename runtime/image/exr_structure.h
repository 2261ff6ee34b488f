// SPDX-License-Identifier: Apache-2.0
// What an OpenEXR file holds, and whether every size and offset in it is true: pixel decoders trust both.
#pragma once

#include <cstdint>
#include <map>
#include <span>
#include <string>

namespace pointrt {

enum class ExrPixel : std::uint32_t { kUint = 0, kHalf = 1, kFloat = 2 };

struct ExrStructure {
    std::uint32_t width = 0, height = 0; ///< of the data window, 1 to kMaxPixelSide
    std::map<std::string, ExrPixel> channels;
    std::map<std::string, std::string> texts; ///< the string attributes
};

/// Checks all of file but the pixels' coding: header, offset table, head and size of every block.
/// Taken are single-part scan lines that are not compressed or by RLE, ZIP, ZIPS or PIZ, with at most 64 channels of
/// full resolution, 4 GiB once decoded. The layout is "OpenEXR File Layout" of openexr.com.
/// Throws Error kBadInput "PATH: reason".
ExrStructure checkExr(const std::string& path, std::span<const std::uint8_t> file);

} // namespace pointrt

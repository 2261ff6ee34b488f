// SPDX-License-Identifier: Apache-2.0
// Validates every size and offset in an OpenEXR file, because pixel decoders trust them, and lists its channels.
#pragma once

#include <cstdint>
#include <map>
#include <span>
#include <string>

namespace pointrt {

/// The magic number and version. No flags are set besides the version: single part, scan lines, short names.
constexpr std::uint32_t kExrMagic = 20000630, kExrVersion = 2;

enum class ExrPixel : std::uint32_t { kUint = 0, kHalf = 1, kFloat = 2 };

struct ExrStructure {
    std::uint32_t width = 0, height = 0; ///< of the data window, 1 to kMaxPixelSide
    std::map<std::string, ExrPixel> channels;
    std::map<std::string, std::string> texts; ///< the string attributes
};

/// Checks the header, the offset table, and the head and size of every block, but not the encoded pixels. Accepts
/// single-part scan-line files with no, RLE, ZIP, ZIPS or PIZ compression, up to 64 channels of full resolution and 4
/// GiB decoded. Follows "OpenEXR File Layout" of openexr.com.
/// Throws Error kBadInput "PATH: reason".
ExrStructure checkExr(const std::string& path, std::span<const std::uint8_t> file);

} // namespace pointrt

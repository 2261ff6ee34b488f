// SPDX-License-Identifier: Apache-2.0
// How much memory a picture may ask for, going by the size of its file.
#pragma once

#include <cstdint>
#include <string>

namespace pointrt {

/// What any picture may take: RGB floats of 5792 x 3862 pixels, larger than most skies.
constexpr std::uint64_t kPictureBytesAtLeast = std::uint64_t{256} << 20;

/// And for each byte of its file. The densest rows that Radiance pictures are written in today hold 127 pixels in 8
/// bytes (a run of each component), which are 190 bytes of RGB floats. Older codings and deflate reach 16384 and more.
constexpr std::uint64_t kPictureBytesPerByte = 192;

constexpr std::uint64_t pictureRoom(std::uint64_t file_bytes) {
    return kPictureBytesAtLeast + kPictureBytesPerByte * file_bytes;
}

/// Why a picture of more than that is refused.
inline std::string pictureRoomReason(std::uint64_t width, std::uint64_t height, std::uint64_t file_bytes) {
    return std::to_string(width) + " x " + std::to_string(height) + " pixels from " + std::to_string(file_bytes) +
           " bytes: a picture may take 256 MiB, and 192 bytes for each of its file; make it smaller";
}

} // namespace pointrt

// SPDX-License-Identifier: Apache-2.0
// Memory limit for decoding a picture, by the size of its file.
#pragma once

#include <cstdint>
#include <string>

namespace pointrt {

/// Limit for every picture: RGB floats of 5792 x 3862 pixels, more than most skies have.
constexpr std::uint64_t kPictureBytesAtLeast = std::uint64_t{256} << 20;

/// Additional limit per byte of the file. The densest rows of current Radiance writers hold 127 pixels in 8 bytes (a
/// run per component), which is 190 bytes of RGB floats per byte. Older codings and deflate reach 16384 and more.
constexpr std::uint64_t kPictureBytesPerByte = 192;

constexpr std::uint64_t pictureRoom(std::uint64_t file_bytes) {
    return kPictureBytesAtLeast + kPictureBytesPerByte * file_bytes;
}

/// The reason for refusing a larger picture.
inline std::string pictureRoomReason(std::uint64_t width, std::uint64_t height, std::uint64_t file_bytes) {
    return std::to_string(width) + " x " + std::to_string(height) + " pixels from " + std::to_string(file_bytes) +
           " bytes: the limit is 256 MiB plus 192 bytes per byte of the file; make the picture smaller";
}

} // namespace pointrt

// SPDX-License-Identifier: Apache-2.0
// Reads OpenEXR files: checks their structure, then decodes them with tinyexr.
#pragma once

#include <cstdint>
#include <map>
#include <memory>
#include <span>
#include <string>

namespace pointrt {

/// The channels as planes of width * height values, row-major, y down.
struct ExrPicture {
    std::uint32_t width = 0, height = 0;
    std::map<std::string, std::span<const float>> floats; ///< 16-bit floats are converted
    std::map<std::string, std::span<const std::uint32_t>> words;
    std::map<std::string, std::string> texts; ///< the string attributes
    std::shared_ptr<const void> storage;      ///< owns the planes
};

/// Which pictures to expect: films saved by this viewer, which may compress a thousandfold if empty, or other pictures,
/// whose decoded size is limited by the size of their file (pictureRoom).
enum class ExrKind { kFilm, kPicture };

/// Reads the files that checkExr accepts. Values are unchanged, including infinities and NaN.
/// Throws Error kBadInput "PATH: reason".
ExrPicture readExr(const std::string& path, ExrKind kind);

} // namespace pointrt

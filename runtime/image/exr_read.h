// SPDX-License-Identifier: Apache-2.0
// OpenEXR files, read by tinyexr once their structure is checked.
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
    std::map<std::string, std::span<const float>> floats; ///< 16-bit floats too
    std::map<std::string, std::span<const std::uint32_t>> words;
    std::map<std::string, std::string> texts; ///< the string attributes
    std::shared_ptr<const void> storage;      ///< what the planes lie in
};

/// Whose files: films that this viewer saved, of which an empty one is a thousandth of its size, or any pictures, which
/// get no more room than their files' sizes allow (pictureRoom).
enum class ExrKind { kFilm, kPicture };

/// What is taken: checkExr. Values are as they lie in the file, infinities and NaN included.
/// Throws Error kBadInput "PATH: reason".
ExrPicture readExr(const std::string& path, ExrKind kind);

} // namespace pointrt

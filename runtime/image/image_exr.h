// SPDX-License-Identifier: Apache-2.0
// Writes channels, or a film, as an OpenEXR file.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>

#include "runtime/image/exr_structure.h"
#include "runtime/image/film.h"

namespace pointrt {

/// A channel of 32-bit values (kUint or kFloat). The value of pixel i (row-major, y down) is i * stride values after
/// data.
struct ExrChannel {
    std::string name; ///< unique, at most 31 bytes
    const void* data = nullptr;
    std::size_t stride = 1;
    ExrPixel type = ExrPixel::kFloat;
};

/// A string attribute. The name has at most 31 bytes.
struct ExrText {
    std::string name, value;
};

struct ExrSize {
    std::uint32_t width = 0, height = 0;
};

/// Writes channels, in any order, atomically to path: 32 bits per value, ZIP-compressed scan lines.
/// Follows "OpenEXR File Layout" of openexr.com, single part, version 2.
/// Throws Error kCannotWrite "PATH: reason".
void writeExr(const std::string& path, ExrSize size, std::span<const ExrChannel> channels,
              std::span<const ExrText> texts = {});

/// Writes the arrays of film that are not empty, with the channel names of runtime/image/film_parts.h; rgba at least.
/// Throws Error kCannotWrite "PATH: reason".
void writeExr(const std::string& path, const Film& film, std::span<const ExrText> texts = {});

} // namespace pointrt

// SPDX-License-Identifier: Apache-2.0
// Planes of numbers as an OpenEXR file, and a film as one.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>

#include "runtime/image/exr_structure.h"
#include "runtime/image/film.h"

namespace pointrt {

/// Where a channel's value of pixel i (row-major, y down) lies: i * stride values after data. 32 bits each: kUint or
/// kFloat.
struct ExrChannel {
    std::string name; ///< at most 31 bytes, unlike all others
    const void* data = nullptr;
    std::size_t stride = 1;
    ExrPixel type = ExrPixel::kFloat;
};

/// An attribute of type string. The name has at most 31 bytes.
struct ExrText {
    std::string name, value;
};

struct ExrSize {
    std::uint32_t width = 0, height = 0;
};

/// Writes the channels, in any order, to path, all or nothing: 32 bits a value in ZIP-compressed scan lines.
/// The layout is "OpenEXR File Layout" of openexr.com, single part, version 2.
/// Throws Error kCannotWrite "PATH: reason".
void writeExr(const std::string& path, ExrSize size, std::span<const ExrChannel> channels,
              std::span<const ExrText> texts = {});

/// Writes what film has, by the names of runtime/image/film_parts.h; rgba at least.
/// Throws Error kCannotWrite "PATH: reason".
void writeExr(const std::string& path, const Film& film, std::span<const ExrText> texts = {});

} // namespace pointrt

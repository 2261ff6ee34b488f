// SPDX-License-Identifier: Apache-2.0
// PNG files: 8-bit sRGB pictures, and whole numbers that are no colours.
#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "runtime/util/output_file.h"

namespace pointrt {

struct PngSize {
    std::uint32_t width = 0, height = 0;
    std::uint32_t channels = 4; ///< 1: grey, 3: RGB, 4: RGBA with straight alpha
    std::uint32_t bits = 8;     ///< of each; 16: rows are of std::uint16_t, as they lie in memory
    bool is_color = true;       ///< sRGB; else numbers of another meaning, for which the file says nothing
};

/// A PNG whose rows come from the top, a few at a time: it keeps none of them.
/// Each function throws Error kCannotWrite "PATH: reason".
class PngWriter {
public:
    PngWriter(const std::string& path, PngSize size, Writing writing = Writing::kWhole);
    ~PngWriter();

    /// The next rows, whole ones, with an sRGB chunk before the first where they are colours.
    void addRows(std::span<const std::uint8_t> rows);
    /// After the last row.
    void finish();

private:
    struct State;
    std::unique_ptr<State> state_;
};

/// An 8-bit sRGB picture: rows from the top, RGB or (with straight alpha) RGBA.
struct Image8 {
    std::uint32_t width = 0, height = 0;
    std::uint32_t channels = 4; ///< 3 or 4
    std::vector<std::uint8_t> pixels;
};

/// Writes image to path, all or nothing, with an sRGB chunk. Throws Error kCannotWrite "PATH: reason".
void writePng(const std::string& path, const Image8& image);

/// Writes grey numbers of 16 bits, rows from the top, likewise, without one.
void writePng16(const std::string& path, std::uint32_t width, std::span<const std::uint16_t> numbers);

} // namespace pointrt

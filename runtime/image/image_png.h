// SPDX-License-Identifier: Apache-2.0
// Writes PNG files: 8-bit sRGB pictures, and integers that are not colours.
#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "runtime/image/row_writer.h"
#include "runtime/util/output_file.h"

namespace pointrt {

struct PngSize {
    std::uint32_t width = 0, height = 0;
    std::uint32_t channels = 4; ///< 1: grey, 3: RGB, 4: RGBA with straight alpha
    std::uint32_t bits = 8;     ///< per channel; 16: rows are arrays of std::uint16_t
    bool is_color = true;       ///< sRGB; false: data, without a colour space chunk
};

/// Writes a PNG row by row from the top, without keeping rows in memory.
/// Each function throws Error kCannotWrite "PATH: reason".
class PngWriter final : public RowWriter {
public:
    /// xmp: an XMP packet, or empty.
    PngWriter(const std::string& path, PngSize size, Writing writing = Writing::kWhole, const std::string& xmp = {});
    ~PngWriter() override;

    /// Appends whole rows.
    void addRows(std::span<const std::uint8_t> rows) override;
    /// Must be called after the last row.
    void finish() override;

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

/// Writes image atomically to path, with an sRGB chunk. Throws Error kCannotWrite "PATH: reason".
void writePng(const std::string& path, const Image8& image);

/// Writes 16-bit grey values, rows from the top, in the same way but without an sRGB chunk.
void writePng16(const std::string& path, std::uint32_t width, std::span<const std::uint16_t> numbers);

} // namespace pointrt

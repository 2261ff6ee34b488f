// SPDX-License-Identifier: Apache-2.0
// Writes TIFF files of 8-bit sRGB pictures, with their place on a map (GeoTIFF 1.1) if they have one.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "runtime/image/geo_reference.h"
#include "runtime/image/row_writer.h"
#include "runtime/util/output_file.h"

namespace pointrt {

struct TiffSize {
    std::uint32_t width = 0, height = 0; ///< at most 4 GiB of pixels
    std::uint32_t channels = 4;          ///< 3: RGB, 4: RGBA with straight alpha
};

/// Rows are compressed in strips (deflate) and written as they arrive, followed by the directory. Cannot write to
/// standard output. Each function throws Error kCannotWrite "PATH: reason".
class TiffWriter final : public RowWriter {
public:
    TiffWriter(const std::string& path, TiffSize size, std::optional<GeoReference> place);

    void addRows(std::span<const std::uint8_t> rows) override;
    void finish() override;

private:
    void writeStrip();
    void append(std::span<const std::uint8_t> bytes);

    OutputFile file_;
    std::string path_;
    TiffSize size_;
    std::optional<GeoReference> place_;
    std::uint32_t strip_rows_;
    std::vector<std::uint8_t> strip_;            ///< the rows of the next strip
    std::vector<std::uint32_t> offsets_, bytes_; ///< of each strip
    std::uint64_t written_ = 0;
};

} // namespace pointrt

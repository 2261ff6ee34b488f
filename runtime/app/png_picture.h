// SPDX-License-Identifier: Apache-2.0
// A film's rows to a PNG, as they come: filtered where that is wanted, and brought to 8 bits.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "runtime/gpu/device.h"
#include "runtime/image/film.h"
#include "runtime/image/image_png.h"
#include "runtime/render/picture_filter.h"
#include "runtime/scene/legend_picture.h"
#include "runtime/util/pixel_size.h"

namespace pointrt {

struct PngPlan {
    std::string path;
    PixelSize size;
    float stops = 0; ///< of exposure
    std::optional<FilterPlan> filter;
    std::optional<Legend> legend; ///< to lie on the picture
    Writing writing = Writing::kWhole;
};

class PngPicture {
public:
    /// Throws Error kCannotRun where the device has not got the memory for the filter.
    PngPicture(Device& device, PngPlan plan);

    /// The next rows, from the top: film's from first on. Throws Error kCannotWrite "PATH: reason".
    void addRows(const Film& film, std::uint32_t first, std::uint32_t rows);
    /// The file is there then, rows that have not come black. Throws as addRows.
    void finish();

    double filterMilliseconds() const { return filter_ms_; }

private:
    void filterRows(const Film& film, std::uint32_t first, std::uint32_t rows);
    void write(std::span<const float> rgba);

    PngPlan plan_;
    std::optional<PictureFilter> filter_;
    std::optional<PngWriter> png_; ///< from the first row on
    std::optional<LegendPicture> legend_;
    std::vector<std::uint8_t> bytes_;
    std::size_t written_ = 0; ///< rows
    std::uint32_t rows_ = 0;  ///< that have come
    double filter_ms_ = 0, write_ms_ = 0;
};

} // namespace pointrt

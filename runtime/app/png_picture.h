// SPDX-License-Identifier: Apache-2.0
// Writes the rows of a film to a PNG or TIFF as they are rendered: denoised if requested, tone-mapped to 8 bits.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "runtime/gpu/device.h"
#include "runtime/image/film.h"
#include "runtime/image/geo_reference.h"
#include "runtime/image/row_writer.h"
#include "runtime/image/tonemap.h"
#include "runtime/render/picture_filter.h"
#include "runtime/scene/overlay.h"
#include "runtime/util/pixel_size.h"

namespace pointrt {

struct PngPlan {
    std::string path;
    PixelSize size;
    ToneMapping tone;
    std::optional<FilterPlan> filter;
    PictureOverlay overlay = {};
    Writing writing = Writing::kWhole;
    std::optional<GeoReference> place = {}; ///< place of a plan on its map
    bool is_panorama = false;               ///< PNGs record it for panorama viewers
};

class PngPicture {
public:
    /// Throws Error kCannotRun if the device has too little memory for the denoiser.
    PngPicture(Device& device, PngPlan plan);

    /// Adds the picture's next rows, from the top: rows [first, first + rows) of film. Throws Error kCannotWrite
    /// "PATH: reason".
    void addRows(const Film& film, std::uint32_t first, std::uint32_t rows);
    /// Completes the file; missing rows are black, or transparent. For a PNG with a place, writes the world file, too.
    /// Throws as addRows does.
    void finish();

    double filterMilliseconds() const { return filter_ms_; }

private:
    void filterRows(const Film& film, std::uint32_t first, std::uint32_t rows);
    void write(std::span<const float> rgba);

    PngPlan plan_;
    std::optional<PictureFilter> filter_;
    std::unique_ptr<RowWriter> file_; ///< created with the first row
    std::vector<std::uint8_t> bytes_;
    std::size_t written_ = 0; ///< rows written
    std::uint32_t rows_ = 0;  ///< rows received
    double filter_ms_ = 0, write_ms_ = 0;
};

} // namespace pointrt

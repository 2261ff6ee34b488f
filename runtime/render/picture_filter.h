// SPDX-License-Identifier: Apache-2.0
// Denoises films on the host, of any size: tile by tile, while rows arrive from the top.
#pragma once

#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include "runtime/gpu/device.h"
#include "runtime/gpu/resources.h"
#include "runtime/image/film.h"
#include "runtime/render/denoiser.h"
#include "runtime/util/pixel_size.h"

namespace pointrt {

/// Size of a tile on the device, including a border of kDenoiseReach pixels except at edges of the picture.
struct FilterTile {
    std::uint32_t width = 0, rows = 0; ///< above 2 * kDenoiseReach each, unless the picture is smaller
};

/// A tile of at most 2 million pixels, whose buffers take a quarter of what every Vulkan device can bind. Smaller
/// pictures are one tile; in large pictures a sixth of the work is repeated in borders. wraps: as in FilterPlan.
FilterTile filterTileFor(PixelSize picture, bool wraps = false);

struct FilterPlan {
    PixelSize picture;
    bool has_variance = false; ///< the film has the variance of the mean; else spatial variance is used
    /// Also filter pixels that the scene does not cover: shadows on the backdrop are noisy too.
    bool covers_all = false;
    FilterTile tile;
    bool wraps = false; ///< the left and right edges of the picture meet: it is a panorama
};

/// Memory of a PictureFilter in bytes, host and device together.
std::uint64_t filterBytes(const FilterPlan& plan);

/// The result is bit-identical however the picture is divided into tiles and rows are added.
class PictureFilter {
public:
    /// Receives the next filtered rows, from the top: 4 floats per pixel, linear rgb and alpha.
    using TakeRows = std::function<void(std::span<const float> rgba)>;

    /// Throws Error kCannotRun if the device lacks memory.
    PictureFilter(Device& device, const FilterPlan& plan, TakeRows take);
    ~PictureFilter();
    PictureFilter(const PictureFilter&) = delete;
    PictureFilter& operator=(const PictureFilter&) = delete;

    /// Adds the next rows of the picture, those of film from first on. Guides are normal, depth, albedo and variance;
    /// empty ones are ignored. The last row of the picture flushes all filtered rows.
    void addRows(const Film& film, std::uint32_t first, std::uint32_t rows);

private:
    using Texels = std::vector<float>; ///< 4 per pixel, complete rows

    void createTile();
    void gather(const Film& film, std::uint32_t row);
    std::uint32_t margin() const { return plan_.wraps ? kDenoiseReach : 0; }
    std::uint32_t gatheredWidth() const { return plan_.picture.width + 2 * margin(); }
    void filterRows();
    void filterTile(std::uint32_t first_column, std::uint32_t columns, std::uint32_t rows);
    void upload(Buffer& buffer, const Texels& texels, std::uint32_t first_column, std::uint32_t columns);

    Device& device_;
    FilterPlan plan_;
    TakeRows take_;
    Buffer color_, surface_, albedo_; ///< DenoiseInputs of a tile
    Denoiser denoiser_;
    /// Input rows from first_row_ on that are still needed, each with a margin of pixels from the other edge.
    Texels colors_, surfaces_, albedos_;
    Texels tile_; ///< staging buffer for transfers to and from the device
    Texels done_;
    std::uint32_t first_row_ = 0, rows_ = 0; ///< of the input rows
    std::uint32_t done_rows_ = 0;            ///< number of the picture's rows passed to take_
};

/// Whether film.variance is valid: every pixel has 2 samples or more (unless film.samples is empty).
bool hasVariance(const Film& film);

/// Filters the colours of film.rgba on device; changes nothing else. Guides are film.normal, depth, albedo and
/// variance; empty ones are ignored. Without valid variance (hasVariance) it uses the spatial variance of similar
/// pixels, which mistakes the edges of sharp shadows for noise. A film without pixels is unchanged. Throws
/// std::logic_error if an array has the wrong size, Error kCannotRun if the device lacks memory. wraps: as in
/// FilterPlan.
void denoiseFilm(Device& device, Film& film, bool wraps = false);

/// The same, but also filters pixels that the scene does not cover: shadows on the backdrop are noisy too.
void denoisePicture(Device& device, Film& film, bool wraps = false);

} // namespace pointrt

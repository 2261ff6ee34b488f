// SPDX-License-Identifier: Apache-2.0
// The denoiser on the host's films, of any size: tile by tile, while rows come from the top.
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

/// What is on the device at once, the kDenoiseReach pixels around what comes of it among them. Edges of pictures have
/// none around.
struct FilterTile {
    std::uint32_t width = 0, rows = 0; ///< above 2 * kDenoiseReach each, but for pictures that are smaller
};

/// 2 million pixels at most: the least that Vulkan promises to bind is four times that. Smaller pictures are one tile;
/// of a large one a sixth of the work is done twice.
FilterTile filterTileFor(PixelSize picture);

struct FilterPlan {
    PixelSize picture;
    bool has_variance = false; ///< of the samples' mean, as a film has it; without, the light's spread stands in
    bool covers_all = false; ///< what the scene does not cover is filtered too: a backdrop has shadows as noisy as any
    FilterTile tile;
};

/// Bytes that a PictureFilter holds, on the host and on the device.
std::uint64_t filterBytes(const FilterPlan& plan);

/// A picture's pixels are the same to the last bit however it is cut into tiles and into rows that are added together.
class PictureFilter {
public:
    /// The next rows that are done, from the top: 4 floats a pixel, linear rgb and alpha.
    using TakeRows = std::function<void(std::span<const float> rgba)>;

    /// Throws Error kCannotRun where the device has not got the memory.
    PictureFilter(Device& device, const FilterPlan& plan, TakeRows take);
    ~PictureFilter();
    PictureFilter(const PictureFilter&) = delete;
    PictureFilter& operator=(const PictureFilter&) = delete;

    /// The next rows of the picture are film's from first on. Its guides are normal, depth, albedo and variance; those
    /// that are empty are not used. After the picture's last row all has been taken.
    void addRows(const Film& film, std::uint32_t first, std::uint32_t rows);

private:
    using Texels = std::vector<float>; ///< 4 a pixel, of rows that are whole

    void createTile();
    void gather(const Film& film, std::uint32_t row);
    void filterRows();
    void filterTile(std::uint32_t first_column, std::uint32_t columns, std::uint32_t rows);
    void upload(Buffer& buffer, const Texels& texels, std::uint32_t first_column, std::uint32_t columns);

    Device& device_;
    FilterPlan plan_;
    TakeRows take_;
    Buffer color_, surface_, albedo_; ///< as in DenoiseInputs, of a tile
    Denoiser denoiser_;
    Texels colors_, surfaces_, albedos_; ///< of the rows from first_row_ on that are still asked for
    Texels tile_;                        ///< on its way to the device, and back
    Texels done_;
    std::uint32_t first_row_ = 0, rows_ = 0; ///< gathered
    std::uint32_t done_rows_ = 0;            ///< of the picture, taken
};

/// Whether film.variance counts: every pixel has 2 samples or more, where film.samples is not empty.
bool hasVariance(const Film& film);

/// Filters film.rgba's colours on device; alpha and all else stay. Guides are film.normal, depth, albedo and variance;
/// those that are empty are not used. The variance counts only where hasVariance; without it the spread of similar
/// pixels around stands in, which takes sharp shadows' edges for noise.
/// A film without pixels stays as it is. Throws std::logic_error when an array has the wrong size, Error kCannotRun
/// when the device cannot.
void denoiseFilm(Device& device, Film& film);

/// The same, with what the scene does not cover taken for covered: a backdrop has shadows as noisy as any.
void denoisePicture(Device& device, Film& film);

} // namespace pointrt

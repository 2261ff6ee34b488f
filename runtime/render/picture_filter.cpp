// SPDX-License-Identifier: Apache-2.0
#include "runtime/render/picture_filter.h"

#include <algorithm>
#include <cstring>
#include <stdexcept>
#include <string>
#include <utility>

#include "runtime/util/on_error.h"

namespace pointrt {
namespace {

constexpr std::uint32_t kTilePixels = 1u << 21;
/// Wider tiles would have few rows, so that their borders would be a large part.
constexpr std::uint32_t kTileWidth = 1u << 12;
constexpr std::uint64_t kTexelBytes = 4 * sizeof(float);
constexpr std::uint64_t kTileBytes =
    kDenoiserBytes + 3 * kTexelBytes + kTexelBytes; ///< per pixel: denoiser, inputs, staging copy

void requireSize(const char* name, const std::vector<float>& values, std::size_t expected, bool may_be_empty) {
    if (values.size() == expected || (may_be_empty && values.empty())) return;
    throw std::logic_error(std::string("film: ") + name + " has " + std::to_string(values.size()) +
                           " values instead of " + std::to_string(expected));
}

void requireSizes(const Film& film) {
    const std::size_t pixels = std::size_t{film.width} * film.height;
    requireSize("rgba", film.rgba, 4 * pixels, false);
    requireSize("normal", film.normal, 3 * pixels, true);
    requireSize("depth", film.depth, pixels, true);
    requireSize("albedo", film.albedo, 3 * pixels, true);
    requireSize("variance", film.variance, pixels, true);
    requireSize("samples", film.samples, pixels, true);
}

/// Appends xyz and w of count pixels from first on. Empty arrays are replaced by missing_xyz and 0.
void interleave(const std::vector<float>& xyz, float missing_xyz, const std::vector<float>& w, std::size_t first,
                std::size_t count, std::vector<float>& texels) {
    const std::size_t end = texels.size();
    texels.resize(end + 4 * count, missing_xyz);
    for (std::size_t i = 0; i < count; ++i) {
        float* texel = texels.data() + end + 4 * i;
        if (!xyz.empty()) std::copy_n(xyz.data() + 3 * (first + i), 3, texel);
        texel[3] = w.empty() ? 0.0f : w[first + i];
    }
}

/// The columns of the result for a tile of this width with borders on both sides.
std::uint32_t innerWidth(std::uint32_t width) { return width - 2 * kDenoiseReach; }

void dropFront(std::vector<float>& texels, std::size_t count) {
    texels.erase(texels.begin(), texels.begin() + static_cast<std::ptrdiff_t>(count));
}

/// For the last row of texels, 4 floats per pixel: adds `margin` pixels from its other end before and after it.
void wrapRow(std::vector<float>& texels, std::size_t width, std::size_t margin) {
    if (margin == 0) return;
    const std::size_t begin = texels.size() - 4 * width;
    const std::vector<float> row(texels.begin() + static_cast<std::ptrdiff_t>(begin), texels.end());
    texels.resize(begin + 4 * (width + 2 * margin));
    for (std::size_t column = 0; column < width + 2 * margin; ++column) {
        const std::size_t from = (column + width - margin % width) % width;
        std::copy_n(row.data() + 4 * from, 4, texels.data() + begin + 4 * column);
    }
}

std::uint32_t marginOf(bool wraps) { return wraps ? kDenoiseReach : 0; }

void filterWhole(Device& device, Film& film, bool covers_all, bool wraps) {
    requireSizes(film);
    if (film.rgba.empty()) return;
    const PixelSize size{film.width, film.height};
    float* next = film.rgba.data();
    PictureFilter filter(device, {size, hasVariance(film), covers_all, filterTileFor(size, wraps), wraps},
                         [&](std::span<const float> rgba) {
                             for (std::size_t i = 0; i < rgba.size(); i += 4) std::copy_n(rgba.data() + i, 3, next + i);
                             next += rgba.size();
                         });
    filter.addRows(film, 0, film.height);
}

} // namespace

FilterTile filterTileFor(PixelSize picture, bool wraps) {
    FilterTile tile{picture.width + 2 * marginOf(wraps), picture.height};
    if (std::uint64_t{tile.width} * tile.rows <= kTilePixels) return tile;
    tile.width = std::min(tile.width, kTileWidth);
    tile.rows = std::min(tile.rows, kTilePixels / tile.width);
    return tile;
}

std::uint64_t filterBytes(const FilterPlan& plan) {
    const std::uint64_t rows = plan.tile.rows;
    const std::uint64_t gathered = 3 * kTexelBytes * rows * (plan.picture.width + 2 * marginOf(plan.wraps));
    const std::uint64_t done = kTexelBytes * rows * plan.picture.width;
    return gathered + done + kTileBytes * rows * plan.tile.width;
}

PictureFilter::PictureFilter(Device& device, const FilterPlan& plan, TakeRows take)
    : device_(device), plan_(plan), take_(std::move(take)) {
    const std::size_t gathered = std::size_t{4} * gatheredWidth() * plan.tile.rows;
    for (Texels* texels : {&colors_, &surfaces_, &albedos_}) texels->reserve(gathered);
    createTile();
}

PictureFilter::~PictureFilter() {
    destroyDenoiser(device_, denoiser_);
    for (Buffer* buffer : {&color_, &surface_, &albedo_}) destroyBuffer(device_, *buffer);
}

void PictureFilter::createTile() {
    const std::uint64_t bytes = kTexelBytes * plan_.tile.width * plan_.tile.rows;
    const OnError undo([&] {
        for (Buffer* buffer : {&color_, &surface_, &albedo_}) destroyBuffer(device_, *buffer);
    });
    const auto create = [&](const char* what) {
        Buffer buffer = createBuffer(device_, what, bytes, VK_BUFFER_USAGE_UNIFORM_TEXEL_BUFFER_BIT);
        createTexelView(device_, what, buffer, VK_FORMAT_R32G32B32A32_SFLOAT);
        return buffer;
    };
    color_ = create("picture");
    surface_ = create("normals and depths");
    albedo_ = create("albedo");
    denoiser_ =
        createDenoiser(device_, plan_.tile.width, plan_.tile.rows, {&color_, &surface_, &albedo_, plan_.has_variance});
    denoiser_.pixel_angle = denoisedPixelAngle(plan_.picture.height);
}

void PictureFilter::addRows(const Film& film, std::uint32_t first, std::uint32_t rows) {
    for (std::uint32_t row = first; row < first + rows; ++row) {
        gather(film, row);
        if (rows_ == plan_.tile.rows || first_row_ + rows_ == plan_.picture.height) filterRows();
    }
}

void PictureFilter::gather(const Film& film, std::uint32_t row) {
    const std::size_t count = film.width, first = count * row, end = colors_.size();
    colors_.insert(colors_.end(), film.rgba.begin() + static_cast<std::ptrdiff_t>(4 * first),
                   film.rgba.begin() + static_cast<std::ptrdiff_t>(4 * (first + count)));
    if (plan_.covers_all)
        for (std::size_t i = end + 3; i < colors_.size(); i += 4)
            if (colors_[i] == 0) colors_[i] = 1;
    interleave(film.normal, 0, film.depth, first, count, surfaces_);
    interleave(film.albedo, 1, film.variance, first, count, albedos_);
    for (Texels* texels : {&colors_, &surfaces_, &albedos_}) wrapRow(*texels, count, margin());
    ++rows_;
}

/// Filters all rows whose neighbourhood has arrived.
void PictureFilter::filterRows() {
    const std::uint32_t width = plan_.picture.width, end = first_row_ + rows_;
    const std::uint32_t done_end = end == plan_.picture.height ? end : end - kDenoiseReach;
    done_.resize(std::size_t{4} * width * (done_end - done_rows_));
    const std::uint32_t step = plan_.tile.width >= gatheredWidth() ? width : innerWidth(plan_.tile.width);
    for (std::uint32_t column = 0; column < width; column += step)
        filterTile(column, std::min(step, width - column), done_end - done_rows_);
    take_(done_);
    done_rows_ = done_end;
    if (end == plan_.picture.height) return;
    const std::uint32_t dropped = done_end - std::min(done_end, kDenoiseReach) - first_row_;
    for (Texels* texels : {&colors_, &surfaces_, &albedos_})
        dropFront(*texels, std::size_t{4} * gatheredWidth() * dropped);
    first_row_ += dropped;
    rows_ -= dropped;
}

/// Filters columns of the next rows into done_.
void PictureFilter::filterTile(std::uint32_t first_column, std::uint32_t columns, std::uint32_t rows) {
    const std::uint32_t width = plan_.picture.width, begin = first_column + margin();
    const std::uint32_t left = begin - std::min(begin, kDenoiseReach);
    denoiser_.width = std::min(begin + columns + kDenoiseReach, gatheredWidth()) - left;
    denoiser_.height = rows_;
    upload(color_, colors_, left, denoiser_.width);
    upload(surface_, surfaces_, left, denoiser_.width);
    upload(albedo_, albedos_, left, denoiser_.width);
    const VkCommandBuffer commands = beginCommands(device_);
    recordDenoise(commands, denoiser_);
    submitAndWait(device_, commands);
    tile_.resize(std::size_t{4} * denoiser_.width * rows_);
    downloadBuffer(device_, denoiser_.result, tile_.data(), tile_.size() * sizeof(float));
    const std::uint32_t above = done_rows_ - first_row_;
    for (std::uint32_t row = 0; row < rows; ++row)
        std::copy_n(tile_.data() + std::size_t{4} * (std::size_t{above + row} * denoiser_.width + begin - left),
                    std::size_t{4} * columns,
                    done_.data() + std::size_t{4} * (std::size_t{row} * width + first_column));
}

void PictureFilter::upload(Buffer& buffer, const Texels& texels, std::uint32_t first_column, std::uint32_t columns) {
    const std::size_t row_floats = std::size_t{4} * columns;
    tile_.resize(row_floats * rows_);
    for (std::uint32_t row = 0; row < rows_; ++row)
        std::copy_n(texels.data() + std::size_t{4} * (std::size_t{row} * gatheredWidth() + first_column), row_floats,
                    tile_.data() + row_floats * row);
    uploadBuffer(device_, buffer, tile_.data(), tile_.size() * sizeof(float));
}

bool hasVariance(const Film& film) {
    return !film.variance.empty() &&
           std::all_of(film.samples.begin(), film.samples.end(), [](float samples) { return samples >= 2; });
}

void denoiseFilm(Device& device, Film& film, bool wraps) { filterWhole(device, film, false, wraps); }

void denoisePicture(Device& device, Film& film, bool wraps) { filterWhole(device, film, true, wraps); }

} // namespace pointrt

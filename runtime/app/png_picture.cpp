// SPDX-License-Identifier: Apache-2.0
#include "runtime/app/png_picture.h"

#include <algorithm>
#include <utility>

#include "runtime/image/image_png.h"
#include "runtime/image/image_tiff.h"
#include "runtime/image/panorama_metadata.h"
#include "runtime/util/clock.h"

namespace pointrt {
namespace {

constexpr std::size_t kPixelsAtOnce = 1 << 20; ///< tone-mapped at once: enough work for all cores

/// Black rows without coverage, and without guides for the denoiser.
Film blankRows(std::uint32_t width, std::uint32_t rows) {
    Film film;
    film.width = width;
    film.height = rows;
    film.rgba.assign(std::size_t{4} * width * rows, 0);
    return film;
}

/// Thumbnails are PNGs, whatever their suffix.
bool isTiff(const PngPlan& plan) { return plan.writing == Writing::kWhole && plan.path.ends_with(".tif"); }

std::unique_ptr<RowWriter> openPicture(const PngPlan& plan, std::uint32_t channels) {
    const auto& [width, height] = plan.size;
    if (isTiff(plan)) return std::make_unique<TiffWriter>(plan.path, TiffSize{width, height, channels}, plan.place);
    const std::string xmp = plan.is_panorama ? panoramaXmp(plan.size) : "";
    return std::make_unique<PngWriter>(plan.path, PngSize{width, height, channels}, plan.writing, xmp);
}

} // namespace

PngPicture::PngPicture(Device& device, PngPlan plan) : plan_(std::move(plan)) {
    if (!plan_.filter) return;
    const Clock::time_point start = Clock::now();
    filter_.emplace(device, *plan_.filter, [this](std::span<const float> rgba) { write(rgba); });
    filter_ms_ = millisecondsSince(start);
}

void PngPicture::addRows(const Film& film, std::uint32_t first, std::uint32_t rows) {
    rows_ += rows;
    if (filter_) return filterRows(film, first, rows);
    const std::size_t row_floats = std::size_t{4} * film.width;
    write(std::span(film.rgba).subspan(row_floats * first, row_floats * rows));
}

void PngPicture::filterRows(const Film& film, std::uint32_t first, std::uint32_t rows) {
    const Clock::time_point start = Clock::now();
    const double written_ms = write_ms_;
    filter_->addRows(film, first, rows);
    filter_ms_ += millisecondsSince(start) - (write_ms_ - written_ms);
}

void PngPicture::write(std::span<const float> rgba) {
    const Clock::time_point start = Clock::now();
    const std::uint32_t channels = channelsOf(plan_.tone);
    if (!file_) file_ = openPicture(plan_, channels);
    const std::size_t row_floats = std::size_t{4} * plan_.size.width;
    const std::size_t step = std::max<std::size_t>(kPixelsAtOnce / plan_.size.width, 1) * row_floats;
    for (; !rgba.empty(); rgba = rgba.subspan(std::min(step, rgba.size()))) {
        const std::span<const float> part = rgba.first(std::min(step, rgba.size()));
        bytes_.resize(part.size() / 4 * channels);
        tonemapPixels(part, plan_.tone, bytes_.data());
        compositeOverlay(plan_.overlay, {bytes_, plan_.size.width, written_, channels});
        written_ += part.size() / row_floats;
        file_->addRows(bytes_);
    }
    write_ms_ += millisecondsSince(start);
}

void PngPicture::finish() {
    constexpr std::uint32_t kRows = 16;
    const Film blank = blankRows(plan_.size.width, kRows);
    while (rows_ < plan_.size.height) addRows(blank, 0, std::min(kRows, plan_.size.height - rows_));
    file_->finish();
    if (!plan_.place || isTiff(plan_)) return;
    const std::string text = worldFileText(*plan_.place);
    writeFile(worldFilePath(plan_.path), {reinterpret_cast<const std::uint8_t*>(text.data()), text.size()});
}

} // namespace pointrt

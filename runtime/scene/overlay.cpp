// SPDX-License-Identifier: Apache-2.0
#include "runtime/scene/overlay.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace pointrt {
namespace {

/// Composites a pixel over one of a picture. Both have straight alpha; without it, the picture is opaque.
void compositePixel(const std::uint8_t* over, std::uint8_t* under, std::size_t channels) {
    const std::uint32_t alpha = channels == 4 ? under[3] : 255u;
    const std::uint32_t over_weight = 255u * over[3], under_weight = alpha * (255u - over[3]);
    const std::uint32_t sum = over_weight + under_weight; // in units of 255 * 255
    if (sum == 0) return;
    for (int c = 0; c < 3; ++c)
        under[c] = static_cast<std::uint8_t>((over[c] * over_weight + under[c] * under_weight + sum / 2) / sum);
    if (channels == 4) under[3] = static_cast<std::uint8_t>((sum + 127) / 255);
}

/// Distance from the line's axis.
double distanceTo(const OverlayLine& line, PixelPlace at) {
    const double dx = line.to.x - line.from.x, dy = line.to.y - line.from.y;
    const double squared = dx * dx + dy * dy;
    const double along = (at.x - line.from.x) * dx + (at.y - line.from.y) * dy;
    const double share = squared > 0 ? std::clamp(along / squared, 0.0, 1.0) : 0;
    return std::hypot(at.x - line.from.x - share * dx, at.y - line.from.y - share * dy);
}

/// The whole numbers from low to high that are below end.
struct Indices {
    std::size_t first = 0, end = 0;
};
Indices indicesWithin(double low, double high, std::size_t end) {
    const double last = static_cast<double>(end);
    return {static_cast<std::size_t>(std::clamp(std::floor(low), 0.0, last)),
            static_cast<std::size_t>(std::clamp(std::ceil(high), 0.0, last))};
}

/// Columns of a row that a line of this reach can touch.
Indices columnsOf(const OverlayLine& line, double y, double reach, std::size_t width) {
    const double dx = line.to.x - line.from.x, dy = line.to.y - line.from.y;
    double first = 0, last = 1; // the part of the line that is within reach of the row, as fractions of its length
    if (dy != 0) {
        const double a = (y - reach - line.from.y) / dy, b = (y + reach - line.from.y) / dy;
        first = std::clamp(std::min(a, b), 0.0, 1.0);
        last = std::clamp(std::max(a, b), 0.0, 1.0);
    }
    const double one = line.from.x + first * dx, other = line.from.x + last * dx;
    return indicesWithin(std::min(one, other) - reach, std::max(one, other) + reach, width);
}

void compositeLine(const OverlayLine& line, const PictureRows& picture) {
    const std::size_t rows = picture.pixels.size() / (picture.channels * picture.width);
    const double reach = line.half_width + 0.5, first = static_cast<double>(picture.first_row);
    const auto [top, bottom] = indicesWithin(std::min(line.from.y, line.to.y) - reach - first,
                                             std::max(line.from.y, line.to.y) + reach - first, rows);
    for (std::size_t row = top; row < bottom; ++row) {
        const double y = first + static_cast<double>(row) + 0.5;
        const auto [left, right] = columnsOf(line, y, reach + 0.5, picture.width);
        for (std::size_t x = left; x < right; ++x) {
            const double covered = reach - distanceTo(line, {static_cast<double>(x) + 0.5, y});
            if (covered <= 0) continue;
            const double alpha = 255 * line.opacity * std::min(covered, 1.0);
            const std::array<std::uint8_t, 4> over = {line.color[0], line.color[1], line.color[2],
                                                      static_cast<std::uint8_t>(std::lround(alpha))};
            compositePixel(over.data(), &picture.pixels[picture.channels * (row * picture.width + x)],
                           picture.channels);
        }
    }
}

} // namespace

void compositeBox(const OverlayBox& box, const PictureRows& picture) {
    const std::size_t rows = picture.pixels.size() / (picture.channels * picture.width);
    const std::size_t bottom = std::min(box.top + box.size.height, picture.first_row + rows);
    const std::size_t right = std::min(box.left + box.size.width, picture.width);
    for (std::size_t y = std::max(box.top, picture.first_row); y < bottom; ++y)
        for (std::size_t x = box.left; x < right; ++x) {
            const std::uint8_t* over = &box.rgba[4 * ((y - box.top) * box.size.width + x - box.left)];
            const std::size_t pixel = (y - picture.first_row) * picture.width + x;
            compositePixel(over, &picture.pixels[picture.channels * pixel], picture.channels);
        }
}

void compositeOverlay(const PictureOverlay& overlay, const PictureRows& picture) {
    for (const OverlayLine& line : overlay.lines) compositeLine(line, picture);
    for (const OverlayBox& box : overlay.boxes) compositeBox(box, picture);
}

std::size_t overlayScale(PixelSize picture) {
    constexpr std::size_t kDesignSide = 512;
    const std::size_t side = std::min(picture.width, picture.height);
    return std::max<std::size_t>(1, (side + kDesignSide / 2) / kDesignSide);
}

} // namespace pointrt

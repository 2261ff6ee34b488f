// SPDX-License-Identifier: GPL-3.0-or-later
#include "preprocess/ingest/mesh_paint.h"

#include <algorithm>
#include <cmath>

namespace pointrt {
namespace {

/// The two pixels on either side of a place along an axis of `size` pixels, and the weight of the second.
struct PixelPair {
    std::size_t first = 0, second = 0;
    double share = 0;
};

/// Places beyond [0, 1] repeat the picture; 1 itself is its far edge, not the near one.
PixelPair pixelsAround(double place, std::uint32_t size) {
    const double inside = place >= 0 && place <= 1 ? place : place - std::floor(place);
    const double last = size - 1.0, pixel = std::clamp(inside * size - 0.5, 0.0, last);
    const auto first = static_cast<std::size_t>(pixel);
    return {first, std::min<std::size_t>(first + 1, size - 1), pixel - std::floor(pixel)};
}

} // namespace

Rgb8 Picture::at(const Eigen::Vector2d& place) const {
    if (!place.allFinite()) return {};
    const PixelPair x = pixelsAround(place.x(), width), y = pixelsAround(1 - place.y(), height);
    Rgb8 color{};
    for (std::size_t channel = 0; channel < 3; ++channel) {
        const auto pixel = [&](std::size_t column, std::size_t row) {
            return double(rgb[(row * width + column) * 3 + channel]);
        };
        const double upper = (1 - x.share) * pixel(x.first, y.first) + x.share * pixel(x.second, y.first);
        const double lower = (1 - x.share) * pixel(x.first, y.second) + x.share * pixel(x.second, y.second);
        color[channel] = static_cast<std::uint8_t>((1 - y.share) * upper + y.share * lower + 0.5);
    }
    return color;
}

Rgb8 MeshPaint::at(std::size_t face, const Vec3d& weights) const {
    const FacePaint& paint = faces[face];
    if (paint.picture == FacePaint::kPlain) return paint.color;
    Eigen::Vector2d place = Eigen::Vector2d::Zero();
    for (int i = 0; i < 3; ++i) place += weights[i] * paint.places[static_cast<std::size_t>(i)].cast<double>();
    return pictures[paint.picture].at(place);
}

} // namespace pointrt

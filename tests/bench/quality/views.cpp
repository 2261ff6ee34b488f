// SPDX-License-Identifier: Apache-2.0
#include "tests/bench/quality/views.h"

#include <tbb/parallel_for.h>

#include <cmath>
#include <limits>

namespace pointrt::quality {

namespace {

constexpr float kNothingHit = std::numeric_limits<float>::infinity();

PixelHits castPixel(const Tracing& truth, const Tracing& splats, const Vec3f& origin, const Vec3f& direction) {
    PixelHits pixel{kNothingHit, kNothingHit, 0, kNothingHit};
    if (const auto hit = truth.firstHit(origin, direction)) {
        pixel.mesh_t = hit->t;
        pixel.mesh_cos = std::abs(hit->normal.normalized().dot(direction));
    }
    if (const auto hit = splats.firstHit(origin, direction)) {
        pixel.splat_t = hit->t;
        pixel.splat_distance =
            truth.distanceWithin(origin + hit->t * direction, std::abs(pixel.splat_t - pixel.mesh_t));
    }
    return pixel;
}

} // namespace

std::vector<Vec3f> viewDirections() {
    std::vector<Vec3f> directions;
    for (int axis = 0; axis < 3; ++axis)
        for (const float sign : {-1.0f, 1.0f}) directions.push_back(sign * Vec3f::Unit(axis));
    for (int corner = 0; corner < 8; ++corner) {
        const Vec3f place(corner & 1 ? 1 : -1, corner & 2 ? 1 : -1, corner & 4 ? 1 : -1);
        directions.push_back(place.normalized());
    }
    return directions;
}

View castView(const Tracing& truth, const Tracing& splats, const Vec3f& direction) {
    const Vec3f u = direction.unitOrthogonal(), v = direction.cross(u);
    View view(static_cast<std::size_t>(kViewSize) * kViewSize);
    tbb::parallel_for(0, kViewSize, [&](int row) {
        for (int column = 0; column < kViewSize; ++column) {
            const auto place = [](int pixel) { return (static_cast<float>(pixel) + 0.5f) * kPixel - kViewHalf; };
            const Vec3f origin = place(column) * u + place(row) * v - 2 * direction; // outside the unit sphere
            view[static_cast<std::size_t>(row) * kViewSize + static_cast<std::size_t>(column)] =
                castPixel(truth, splats, origin, direction);
        }
    });
    return view;
}

} // namespace pointrt::quality

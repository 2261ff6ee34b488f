// SPDX-License-Identifier: Apache-2.0
// Visibility rays of many points.
#pragma once

#include <cstddef>
#include <numeric>
#include <vector>

#include "runtime/studies/row_slices.h"
#include "runtime/studies/visibility_ray.h"

namespace pointrt {

struct PointRays {
    std::vector<VisibilityRay> rays;
    std::vector<std::size_t> points; ///< the point that each ray starts at
};

/// Appends the rays of those points in [first, last) that have one, in order.
/// @param has_ray(point), make(point) called from several threads
template <typename HasRay, typename Make>
void appendRays(std::size_t first, std::size_t last, const HasRay& has_ray, const Make& make, PointRays& to) {
    std::vector<std::size_t> starts(sliceCount(last - first) + 1, 0);
    forSlices(last - first, [&](std::size_t slice, std::size_t from, std::size_t end) {
        for (std::size_t i = from; i < end; ++i) starts[slice + 1] += has_ray(first + i) ? 1 : 0;
    });
    starts[0] = to.rays.size();
    std::partial_sum(starts.begin(), starts.end(), starts.begin());
    to.rays.resize(starts.back());
    to.points.resize(starts.back());
    forSlices(last - first, [&](std::size_t slice, std::size_t from, std::size_t end) {
        std::size_t at = starts[slice];
        for (std::size_t point = first + from; point < first + end; ++point) {
            if (!has_ray(point)) continue;
            to.rays[at] = make(point);
            to.points[at++] = point;
        }
    });
}

} // namespace pointrt

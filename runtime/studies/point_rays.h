// SPDX-License-Identifier: Apache-2.0
// Rays off many points.
#pragma once

#include <cstddef>
#include <numeric>
#include <vector>

#include "runtime/studies/departure.h"
#include "runtime/studies/slices.h"

namespace pointrt {

struct PointRays {
    std::vector<Departure> rays;
    std::vector<std::size_t> points; ///< that they leave
};

/// Adds the rays of the points [first, last) that are wanted, in their order.
/// @param wanted(point): whether there is one; make(point): the ray. Both are called from several threads
template <typename Wanted, typename Make>
void addRays(std::size_t first, std::size_t last, const Wanted& wanted, const Make& make, PointRays& to) {
    std::vector<std::size_t> starts(sliceCount(last - first) + 1, 0);
    forSlices(last - first, [&](std::size_t slice, std::size_t from, std::size_t end) {
        for (std::size_t i = from; i < end; ++i) starts[slice + 1] += wanted(first + i) ? 1 : 0;
    });
    starts[0] = to.rays.size();
    std::partial_sum(starts.begin(), starts.end(), starts.begin());
    to.rays.resize(starts.back());
    to.points.resize(starts.back());
    forSlices(last - first, [&](std::size_t slice, std::size_t from, std::size_t end) {
        std::size_t at = starts[slice];
        for (std::size_t point = first + from; point < first + end; ++point) {
            if (!wanted(point)) continue;
            to.rays[at] = make(point);
            to.points[at++] = point;
        }
    });
}

} // namespace pointrt

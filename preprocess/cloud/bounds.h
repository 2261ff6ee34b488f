// SPDX-License-Identifier: GPL-3.0-or-later
// Bounding boxes in double, so that the extent of any finite floats is finite.
#pragma once

#include <limits>
#include <tbb/blocked_range.h>
#include <tbb/parallel_reduce.h>
#include <vector>

#include "preprocess/cloud/cloud.h"

namespace pointrt::surface {

struct Bounds {
    Vec3d low = Vec3d::Constant(std::numeric_limits<double>::infinity());
    Vec3d high = Vec3d::Constant(-std::numeric_limits<double>::infinity());

    void add(const Vec3d& point) {
        low = low.cwiseMin(point);
        high = high.cwiseMax(point);
    }
    double longestEdge() const { return (high - low).maxCoeff(); }
};

inline Bounds boundsOf(const std::vector<Vec3f>& positions) {
    const auto addRange = [&](const auto& range, Bounds bounds) {
        for (std::size_t i = range.begin(); i < range.end(); ++i) bounds.add(positions[i].cast<double>());
        return bounds;
    };
    const auto both = [](const Bounds& a, const Bounds& b) {
        return Bounds{a.low.cwiseMin(b.low), a.high.cwiseMax(b.high)};
    };
    return tbb::parallel_reduce(tbb::blocked_range<std::size_t>(0, positions.size()), Bounds{}, addRange, both);
}

} // namespace pointrt::surface

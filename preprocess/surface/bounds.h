// SPDX-License-Identifier: GPL-3.0-or-later
// Bounding box in double, so that the extent of any finite floats is finite.
#pragma once

#include <limits>
#include <vector>

#include "preprocess/cloud.h"

namespace pointrt::surface {

struct Bounds {
    Vec3d low = Vec3d::Constant(std::numeric_limits<double>::infinity());
    Vec3d high = Vec3d::Constant(-std::numeric_limits<double>::infinity());

    double longestEdge() const { return (high - low).maxCoeff(); }
};

inline Bounds boundsOf(const std::vector<Vec3f>& positions) {
    Bounds bounds;
    for (const Vec3f& position : positions) {
        bounds.low = bounds.low.cwiseMin(position.cast<double>());
        bounds.high = bounds.high.cwiseMax(position.cast<double>());
    }
    return bounds;
}

} // namespace pointrt::surface

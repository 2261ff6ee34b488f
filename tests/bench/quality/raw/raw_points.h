// SPDX-License-Identifier: Apache-2.0
// The points of a scan, for what was sampled and how densely.
#pragma once

#include <string>

#include "preprocess/surface/neighbors.h"
#include "tests/bench/quality/scenes.h"

namespace pointrt::quality {

class RawPoints {
public:
    /// positions: unit frame, not empty.
    explicit RawPoints(std::vector<Vec3f> positions);
    RawPoints(const RawPoints&) = delete; // search_ points into positions_
    RawPoints& operator=(const RawPoints&) = delete;

    /// Whether a point lies within reach of the place.
    bool isSampled(const Vec3f& place, float reach) const;
    /// Edge of the square that each of the kSpacingPoints around the point nearest to the place has to itself.
    float spacingAt(const Vec3f& place) const;

private:
    std::vector<Vec3f> positions_;
    surface::NearestSearch search_;
};

/// Enough that a line of samples does not look dense all by itself, few enough to stay local.
constexpr std::size_t kSpacingPoints = 16;

/// Reads scans as pointrt-bake does. Throws Error.
RawPoints loadRawPoints(const std::vector<std::string>& paths, const UnitFrame& frame);

} // namespace pointrt::quality

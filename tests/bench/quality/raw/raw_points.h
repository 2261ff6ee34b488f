// SPDX-License-Identifier: Apache-2.0
// The points of a scan: what was sampled, and how densely.
#pragma once

#include <string>

#include "preprocess/surface/neighbors.h"
#include "tests/bench/quality/scenes.h"

namespace pointrt::quality {

class RawPoints {
public:
    /// positions: in the unit frame, at least one.
    explicit RawPoints(std::vector<Vec3f> positions);
    RawPoints(const RawPoints&) = delete; // search_ points into positions_
    RawPoints& operator=(const RawPoints&) = delete;

    /// Whether there is a point within reach of the place.
    bool isSampled(const Vec3f& place, float reach) const;
    /// Spacing around the point nearest to the place: edge of the square that each of its kSpacingPoints neighbours has
    /// to itself.
    float spacingAt(const Vec3f& place) const;

private:
    std::vector<Vec3f> positions_;
    surface::NearestSearch search_;
};

/// Enough that a line of samples does not look dense, few enough to stay local.
constexpr std::size_t kSpacingPoints = 16;

/// Reads scans as pointrt-bake does. Throws Error.
RawPoints loadRawPoints(const std::vector<std::string>& paths, const UnitFrame& frame);

} // namespace pointrt::quality

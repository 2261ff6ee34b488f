// SPDX-License-Identifier: Apache-2.0
// Polygons in a plane, cut into the cells of a raster.
#pragma once

#include <array>
#include <vector>

namespace pointrt {

using PlanePoint = std::array<double, 2>;

/// An area and its centroid; the sign of the area says in which sense the polygon's corners go around.
struct PlaneArea {
    double area = 0;
    PlanePoint centroid{};
};

/// Area 0 has no centroid.
PlaneArea areaOf(const std::vector<PlanePoint>& polygon);

/// The part of a polygon with low <= coordinate <= high on an axis. A polygon that is not convex may be left with edges
/// there and back along the limits, which add nothing to areas.
std::vector<PlanePoint> clippedTo(const std::vector<PlanePoint>& polygon, std::size_t axis, double low, double high);

} // namespace pointrt

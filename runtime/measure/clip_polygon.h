// SPDX-License-Identifier: Apache-2.0
// Polygons in a plane, cut into the cells of a raster.
#pragma once

#include <array>
#include <vector>

namespace pointrt {

using PlanePoint = std::array<double, 2>;

/// An area and its centroid. The sign of the area is that of the polygon's orientation.
struct PlaneArea {
    double area = 0;
    PlanePoint centroid{};
};

/// The centroid is meaningless if the area is 0.
PlaneArea areaOf(const std::vector<PlanePoint>& polygon);

/// The part of a polygon with low <= coordinate <= high on an axis. The result of a concave polygon may have pairs of
/// coincident edges along the limits, which add nothing to areas.
std::vector<PlanePoint> clippedTo(const std::vector<PlanePoint>& polygon, std::size_t axis, double low, double high);

} // namespace pointrt

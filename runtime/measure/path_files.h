// SPDX-License-Identifier: Apache-2.0
// Files of a measured path.
#pragma once

#include <string>
#include <vector>

#include "pointrt/measure.hpp"

namespace pointrt {

/// decimals: of the numbers in these texts. points: at least two.
struct MeasuredPath {
    std::vector<Position> points;
    PathMeasures measures;
    int decimals = 3;
};
/// A row for each point: number, x, y, z, length up to it.
std::string pathCsv(const MeasuredPath& path);
/// A feature with a LineString, and one with a Polygon for three points or more, in the scan's coordinate system.
std::string pathGeoJson(const MeasuredPath& path);
/// A 3D polyline.
std::string pathDxf(const MeasuredPath& path);

} // namespace pointrt

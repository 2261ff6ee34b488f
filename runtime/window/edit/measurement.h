// SPDX-License-Identifier: Apache-2.0
// Lengths, heights, angles and areas of picked points, and files of them.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "runtime/util/vec.h"
#include "runtime/window/edit/workspace.h"

namespace pointrt {

/// Measures of a polyline, in units of its points. The last leg is the one between its last two points.
struct PathMeasures {
    double length = 0; ///< of all legs
    double last_leg = 0;
    Vec3 difference;                 ///< along the last leg
    double horizontal = 0;           ///< of the last leg, across up
    double height = 0;               ///< of the last leg, along up
    std::optional<double> angle_deg; ///< between the last two legs: 180 if they go straight on
    std::optional<double> area; ///< of the polygon that the points enclose; of one that is not flat, its vector area
    std::optional<double> plan_area; ///< of the polygon seen along up
};

/// points: at least two. up: unit length.
PathMeasures measurePath(std::span<const Vec3> points, Vec3 up);

std::vector<Vec3> pickedPositions(const std::vector<PickedPoint>& picks);

/// Numbers of these texts have this many decimals. points: at least two.
struct MeasuredPath {
    std::vector<Vec3> points;
    PathMeasures measures;
    int decimals = 3;
};
/// A row for each point: number, x, y, z, length up to it.
std::string csvText(const MeasuredPath& path);
/// A feature with a LineString, and one with a Polygon for three points or more, in the scan's coordinate system.
std::string geoJsonText(const MeasuredPath& path);
/// A 3D polyline (DXF of AutoCAD R12).
std::string dxfText(const MeasuredPath& path);

} // namespace pointrt

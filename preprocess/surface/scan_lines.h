// SPDX-License-Identifier: GPL-3.0-or-later
// Scan lines: points much closer along the sweep of a scanner than across it.
#pragma once

#include <array>
#include <optional>

#include "preprocess/surface/point_graph.h"

namespace pointrt::surface {

/// A scan line at one of its points, in the tangent plane.
struct ScanLine {
    Vec3f along = Vec3f::Zero(); ///< unit length
    float step = 0;              ///< distance from point to point
};

/// A point of the next line of the same surface, on the other side of a gap.
struct Facing {
    std::uint32_t point = 0;
    Vec3f across = Vec3f::Zero(); ///< from the point on this side to the next line, perpendicular to this line
};

/// The line through a point, if its six nearest neighbours lie on one, or the nine nearest of a list on a line.
std::optional<ScanLine> lineAt(const PointGraph& graph, std::size_t point);

/// The next line on one side (1 or -1) of a point's own, if one surface joins both: 3 to 512 steps away with nothing in
/// between; normals within 30 degrees, lines parallel within 25, and the nearest points of both within a tenth of the
/// gap of a common plane.
std::optional<Facing> facingLine(const PointGraph& graph, std::size_t point, const ScanLine& line, float side);

} // namespace pointrt::surface

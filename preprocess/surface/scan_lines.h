// SPDX-License-Identifier: GPL-3.0-or-later
// Lines in which a scanner swept over a surface: close along them, far across.
#pragma once

#include <array>
#include <optional>

#include "preprocess/surface/neighbors.h"

namespace pointrt::surface {

/// The line that a point lies on, in its tangent plane.
struct ScanLine {
    Vec3f along = Vec3f::Zero(); ///< unit length
    float step = 0;              ///< from point to point
};

/// What lies across a gap: a point of the next line, on the same surface.
struct Facing {
    std::uint32_t point = 0;
    Vec3f across = Vec3f::Zero(); ///< from the point on this side to the next line, square to the own line
};

/// Points with lists of neighbours, and a search over them.
struct LineJob {
    const Points& points;
    const NeighborLists& lists;
    const NearestSearch& search;
};

/// The line of a point, if its six nearest neighbours lie on one.
std::optional<ScanLine> lineAt(const LineJob& job, std::size_t point);

/// The next line on one side (1 or -1) of a point's own, where a surface joins the two: 3 to 128 steps away with
/// nothing between; normals agree within 30 degrees, the lines run the same way, and the nearest points of both lie
/// within a tenth of the gap of one plane, give or take the curvature that the normals tell.
std::optional<Facing> facingLine(const LineJob& job, std::size_t point, const ScanLine& line, float side);

} // namespace pointrt::surface

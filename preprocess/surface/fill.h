// SPDX-License-Identifier: GPL-3.0-or-later
// Fills the gaps between widely spaced scan lines with interpolated points.
#pragma once

#include <array>
#include <optional>

#include "preprocess/surface/point_graph.h"

namespace pointrt::surface {

/// Limit of rows on each side of a line. Wider gaps get rows further apart.
constexpr std::uint32_t kMostRows = 6;
/// Limit of filling points per point of the cloud: no more is invented than was measured. Beyond it, there are fewer
/// rows everywhere.
constexpr double kMostFilling = 1;

/// Least planarity weight of a point that gets filling points beside it.
constexpr float kSurface = 0.9f;

/// [0]: number of points beside a gap; [rows]: number of filling points with at most that many rows on a side.
using FillCounts = std::array<std::size_t, kMostRows + 1>;

/// Limit of rows to fill a cloud's gaps with; 0 if fewer than one point in fifty is beside a gap.
std::uint32_t rowsToFill(const FillCounts& counts, std::size_t points);

/// Inserts points between the scan lines of a surface (facingLine), as far apart along the lines as across. Those up to
/// half the way to the next line start from points of this one: on the cubic Hermite curve tangent to the surface at
/// both lines, with interpolated normals and colours. They are appended to the points, with all other values of the
/// point they start from, and the graph is rebuilt. Points with given radii get none, nor do those with a planarity
/// below kSurface.
/// @param rows limit decided for a larger cloud; otherwise by rowsToFill
/// @param counts what rowsToFill needs of this cloud; unchanged if rows is 0
/// @return the point that each appended one starts from
/// The result does not depend on the number of threads.
std::vector<std::uint32_t> fillBetweenLines(PointGraph& graph, std::optional<std::uint32_t> rows, FillCounts& counts,
                                            const StageShare& share);

} // namespace pointrt::surface

// SPDX-License-Identifier: GPL-3.0-or-later
// Fills the gaps between widely spaced scan lines with interpolated points.
#pragma once

#include <array>
#include <optional>

#include "preprocess/surface/point_graph.h"

namespace pointrt::surface {

/// Limit of filling points per point and side. Wider gaps, of more than twice as many steps, get rows further apart.
constexpr std::uint32_t kMostRows = 6;
/// Limit of filling points per point of the cloud on average; beyond it, rows are further apart everywhere.
constexpr double kMostFilling = 4;

/// Least planarity weight of a point that gets filling points beside it.
constexpr float kSurface = 0.9f;

/// [0]: number of points beside a gap; [rows]: number of points that fill the gaps with at most that many rows.
using FillCounts = std::array<std::size_t, kMostRows + 1>;

/// Limit of rows to fill a cloud's gaps with; 0 if fewer than one point in fifty is beside a gap.
std::uint32_t rowsToFill(const FillCounts& counts, std::size_t points);

/// Inserts points between the scan lines of a surface (facingLine), each point up to half the way to the next line: on
/// the cubic Hermite curve tangent to the surface at both lines, with interpolated normals and colours. They are
/// appended to the points, with all other values of the point they start from, and the graph is rebuilt. Points with
/// given radii get none, nor do those with a planarity below kSurface.
/// @param rows limit decided for a larger cloud; otherwise by rowsToFill
/// @param counts what rowsToFill needs of this cloud; unchanged if rows is 0
/// @return the point that each appended one starts from
/// The result does not depend on the number of threads.
std::vector<std::uint32_t> fillBetweenLines(PointGraph& graph, std::optional<std::uint32_t> rows, FillCounts& counts,
                                            const StageShare& share);

} // namespace pointrt::surface

// SPDX-License-Identifier: GPL-3.0-or-later
// Surfaces that were swept in lines far apart, sampled as closely across as along.
#pragma once

#include <array>
#include <optional>

#include "preprocess/surface/neighbors.h"

namespace pointrt::surface {

/// Most filling points to a point and side. Gaps of more than twice as many steps get rows further apart.
constexpr std::uint32_t kMostRows = 6;
/// Most filling points to a point of the cloud, on the average: above, rows stand further apart everywhere.
constexpr double kMostFilling = 4;

/// Share of a surface (sheetShares) that a point has beside which something is put.
constexpr float kSurface = 0.9f;

/// [0] how many points have a gap beside them, [rows] how many points fill the gaps in so many rows at most.
using FillCounts = std::array<std::size_t, kMostRows + 1>;

/// So many rows at most that a cloud is to be filled with; 0: not at all, as fewer than one point in fifty has a gap
/// beside it.
std::uint32_t rowsToFill(const FillCounts& counts, std::size_t points);

/// Puts points between the scan lines of one surface (facingLine), each point half the way to the next line: on the
/// cubic that leaves both lines in their tangent planes (Hermite's), normals turning from one to the other, colours
/// blended. They stand behind all others in points; what lies in lists and search is then made anew, as of one cloud
/// evenly sampled. Points with a radius of their own stay as they are.
/// @param rows at most, decided for a larger cloud; else rowsToFill says
/// @param counts what this cloud would decide by; not counted where rows are none
/// @param sheets [points], below kSurface: scattered, nothing is put beside it; or empty, all are of surfaces
/// @return of each point added, that which it was put beside
/// The result does not depend on the number of threads.
std::vector<std::uint32_t> fillBetweenLines(Points& points, NeighborLists& lists, std::optional<NearestSearch>& search,
                                            const std::vector<float>& sheets, std::optional<std::uint32_t> rows,
                                            FillCounts& counts, const StageShare& share);

} // namespace pointrt::surface

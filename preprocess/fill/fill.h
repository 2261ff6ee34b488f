// SPDX-License-Identifier: GPL-3.0-or-later
// Surfaces that were swept in lines far apart, sampled as closely across as along.
#pragma once

#include <optional>

#include "preprocess/neighbors/neighbors.h"

namespace pointrt::surface {

/// Most filling points to a point and side. Gaps of more than twice as many steps get rows further apart.
constexpr std::uint32_t kMostRows = 6;
/// Most filling points to a point of the cloud, on the average: above, rows stand further apart everywhere.
constexpr double kMostFilling = 4;

/// Share of a surface (sheetShares) that a point has beside which something is put.
constexpr float kSurface = 0.9f;

/// Puts points between the scan lines of one surface (facingLine), each point half the way to the next line: on the
/// cubic that leaves both lines in their tangent planes (Hermite's), normals turning from one to the other, colours
/// blended. They stand behind all others in points; what lies in lists and search is then made anew, as of one cloud
/// evenly sampled. Points with a radius of their own and clouds of which fewer than one point in fifty has a gap beside
/// it stay as they are.
/// @param sheets [points], below kSurface: scattered, nothing is put beside it; or empty, all are of surfaces
/// @return of each point added, that which it was put beside
/// The result does not depend on the number of threads.
std::vector<std::uint32_t> fillBetweenLines(Points& points, NeighborLists& lists, std::optional<NearestSearch>& search,
                                            const std::vector<float>& sheets, const StageShare& share);

} // namespace pointrt::surface

// SPDX-License-Identifier: GPL-3.0-or-later
// Fits planes to windows around the cells of a depth frame that stay on one surface.
#pragma once

#include <cstdint>
#include <vector>

#include "preprocess/surface/depth_frame.h"

namespace pointrt {

/// Number of cells, up to kLongest, that a surface extends from each cell: until a neighbour is missing or differs in
/// depth by more than a jump.
struct Arms {
    static constexpr int kLongest = 48;
    std::vector<std::uint8_t> left, right, up, down; ///< [rows][columns]
};

/// @param jump limit of the difference between adjacent cells, in steps
Arms findArms(const DepthFrame& frame, const DepthSteps& steps, double jump);

/// A plane's value in a cell and its root mean square residual, both in 1 / depth; NaN if the window has fewer than two
/// rows or columns.
struct PlaneValue {
    double value, residual;
};

/// Fits a plane to a window around each cell of rows [first, last): the cells along its arms up and down, and from each
/// of these along its arms left and right, up to radius (Zhang, Lu and Lafruit, "Cross-based local stereo matching
/// using orthogonal integral images", 2009). The time does not depend on the radius, except for the rows around.
/// @param values [last - first][columns]
void fitPlanes(const DepthFrame& frame, const Arms& arms, int radius, std::uint32_t first, std::uint32_t last,
               std::vector<PlaneValue>& values);

} // namespace pointrt

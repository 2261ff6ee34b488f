// SPDX-License-Identifier: GPL-3.0-or-later
// Planes fitted to what lies around each cell of a depth frame and belongs to the same surface.
#pragma once

#include <cstdint>
#include <vector>

#include "preprocess/surface/depth_frame.h"

namespace pointrt {

/// How many cells a surface goes on from each, kLongest at most: no neighbour on the way is missing or further in depth
/// than a jump.
struct Arms {
    static constexpr int kLongest = 48;
    std::vector<std::uint8_t> left, right, up, down; ///< [rows][columns]
};

/// @param steps a jump has more than so many of the steps there
Arms findArms(const DepthFrame& frame, const DepthSteps& steps, double jump);

/// A plane's value in a cell and the root of its mean squared residual, both in 1 / depth; NaN where the window has no
/// two rows and columns.
struct PlaneValue {
    double value, residual;
};

/// For the cells of rows [first, last) the plane through a window: the cells up and down the cell's arms, and from each
/// of these left and right along its own, no further than radius (Zhang, Lu and Lafruit, "Cross-based local stereo
/// matching using orthogonal integral images", 2009). Takes the same time for any radius but for the rows around.
/// @param values [last - first][columns]
void fitPlanes(const DepthFrame& frame, const Arms& arms, int radius, std::uint32_t first, std::uint32_t last,
               std::vector<PlaneValue>& values);

} // namespace pointrt

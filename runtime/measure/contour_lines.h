// SPDX-License-Identifier: Apache-2.0
// Contour lines of a raster of heights, by marching squares (Lorensen and Cline, Marching Cubes, 1987, in the plane).
#pragma once

#include <cstddef>
#include <vector>

namespace pointrt {

/// A height grid, row by row from its lower left node; NaN where there is no surface.
struct HeightRaster {
    std::size_t columns = 0, rows = 0; ///< of nodes
    std::vector<double> heights;
    double at(std::size_t column, std::size_t row) const { return heights[row * columns + column]; }
};

/// A point between nodes, in cells from the first node.
struct RasterPoint {
    double column = 0, row = 0;
    bool operator==(const RasterPoint&) const = default;
};

struct ContourLine {
    std::vector<RasterPoint> points; ///< at least two; higher ground lies on the left of the line, rows counted upwards
    bool closed = false;             ///< the last point is followed by the first
};

/// The lines at a level, linear between nodes. They end at the border, and where heights are missing. In a saddle, the
/// mean of the four corners decides. A node at the level counts as above it.
std::vector<ContourLine> contourLines(const HeightRaster& raster, double level);

} // namespace pointrt

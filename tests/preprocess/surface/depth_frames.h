// SPDX-License-Identifier: Apache-2.0
// Range grids of surfaces whose depths are known.
#pragma once

#include <cmath>
#include <functional>

#include "preprocess/cloud/cloud.h"

namespace pointrt::test {

/// The frame of a camera at the origin that looks along +z, rows along +y, with pixels of this width at depth 1. depth
/// gives z at a pixel; NaN: no point.
inline Cloud depthFrame(std::uint32_t rows, std::uint32_t columns, double pixel,
                        const std::function<double(double u, double v)>& depth) {
    Cloud cloud;
    RangeGrid grid;
    grid.rows = rows;
    grid.columns = columns;
    for (std::uint32_t row = 0; row < rows; ++row)
        for (std::uint32_t column = 0; column < columns; ++column) {
            const double u = (column + 0.5 - columns / 2.0) * pixel, v = (row + 0.5 - rows / 2.0) * pixel;
            const double z = depth(u, v);
            grid.point_of_cell.push_back(std::isnan(z) ? RangeGrid::kNoPoint : std::uint32_t(cloud.positions.size()));
            if (!std::isnan(z)) cloud.positions.push_back(Vec3d(u * z, v * z, z).cast<float>());
        }
    cloud.grids.push_back(grid);
    cloud.scans.push_back({"frame", Vec3d(0, 0, 0), 0});
    cloud.sensors.push_back(Vec3f::Zero());
    cloud.sensor_of_point.assign(cloud.positions.size(), 0);
    return cloud;
}

} // namespace pointrt::test

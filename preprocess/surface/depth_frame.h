// SPDX-License-Identifier: GPL-3.0-or-later
// A depth camera's frame: a grid of depths along one axis. Planes are linear in 1 / depth over its cells.
#pragma once

#include <optional>
#include <vector>

#include "preprocess/cloud/cloud.h"

namespace pointrt {

struct DepthFrame {
    std::uint32_t rows = 0, columns = 0;
    std::vector<double> inverse;                         ///< [rows][columns], 1 / depth; 0 without a point
    Vec3d sensor = Vec3d::Zero(), axis = Vec3d::UnitZ(); ///< relative to the cloud's origin; unit length

    std::size_t cell(std::uint32_t row, std::uint32_t column) const { return std::size_t{row} * columns + column; }
};

/// Converts a grid to a frame, if its sensor is known, all points are within 75 degrees of the input axis that it looks
/// along, and it has at most 8192 columns. Frames rotated on reading have no such axis: their original depths are lost.
std::optional<DepthFrame> depthFrameOf(const Cloud& cloud, const RangeGrid& grid);

/// Quantisation steps of depths. They grow with the square of the depth for sensors that measure the disparity of a
/// pattern (Khoshelham and Oude Elberink, "Accuracy and resolution of Kinect depth data", 2012), and are constant for
/// those that write whole millimetres.
struct DepthSteps {
    bool of_inverse = true; ///< the step is constant in 1 / depth, otherwise in depth
    double step = 0;

    /// The step in 1 / depth at a depth.
    double at(double inverse) const { return of_inverse ? step : step * inverse * inverse; }
};

/// Finds a frame's quantisation steps. nullopt if there are fewer than 16 points per distinct depth, if neighbours
/// along rows or columns rarely have equal depths, or if the gaps between depths follow neither law.
std::optional<DepthSteps> findDepthSteps(const Cloud& cloud, const RangeGrid& grid, const DepthFrame& frame);

} // namespace pointrt

// SPDX-License-Identifier: GPL-3.0-or-later
// A frame of a depth camera: a grid of depths along one axis. Planes are linear in 1 / depth over its cells.
#pragma once

#include <optional>
#include <vector>

#include "preprocess/cloud/cloud.h"

namespace pointrt {

struct DepthFrame {
    std::uint32_t rows = 0, columns = 0;
    std::vector<double> inverse;                         ///< [rows][columns], 1 / depth; 0 where there is no point
    Vec3d sensor = Vec3d::Zero(), axis = Vec3d::UnitZ(); ///< relative to the cloud's origin; unit length

    std::size_t cell(std::uint32_t row, std::uint32_t column) const { return std::size_t{row} * columns + column; }
};

/// A grid as a frame, where its sensor is known, all points lie within 75 degrees of the axis of the input that it
/// looks along, and it has at most 8192 columns. What turns frames on reading hides the depths that they were written
/// with.
std::optional<DepthFrame> depthFrameOf(const Cloud& cloud, const RangeGrid& grid);

/// The steps that depths come in: of sensors that measure the shift of a pattern they grow with the square of the depth
/// (Khoshelham and Oude Elberink, "Accuracy and resolution of Kinect depth data", 2012), of others that write whole
/// millimetres they do not.
struct DepthSteps {
    bool of_inverse = true; ///< of 1 / depth, else of the depth
    double step = 0;

    /// In 1 / depth.
    double at(double inverse) const { return of_inverse ? step : step * inverse * inverse; }
};

/// The steps of a frame; nothing where its depths have none: fewer than 16 points a depth, neighbours that hardly ever
/// have the same along rows or along columns, or gaps between the depths that follow neither law.
std::optional<DepthSteps> findDepthSteps(const Cloud& cloud, const RangeGrid& grid, const DepthFrame& frame);

} // namespace pointrt

// SPDX-License-Identifier: GPL-3.0-or-later
// A small sample of points, evenly spread over the occupied space.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "preprocess/cloud/cloud.h"
#include "preprocess/ingest/point_filter.h"

namespace pointrt {

struct SamplePoint {
    Vec3d position; ///< input coordinates
    Vec3f normal = Vec3f::Zero();
    std::uint32_t scan = 0;
};

/// Keeps the first point of each cell of a grid, whose cells double as the sample fills up.
class Sample {
public:
    explicit Sample(std::size_t most_points) : most_points_(most_points) {}

    /// Adds the first point of a cell.
    /// @param edge of the caller's cells, a power of two that never shrinks
    void add(const SamplePoint& point, double edge);

    /// Between a quarter of most_points (if there are as many) and most_points, in the order of the input.
    const std::vector<SamplePoint>& points() const { return points_; }

private:
    bool insert(const SamplePoint& point);
    void coarsen(double edge);

    std::size_t most_points_;
    double edge_ = 0;
    CellSet cells_;
    std::vector<SamplePoint> points_;
};

} // namespace pointrt

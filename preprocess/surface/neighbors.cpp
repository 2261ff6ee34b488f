// SPDX-License-Identifier: GPL-3.0-or-later
#include "preprocess/surface/neighbors.h"

#include <algorithm>
#include <limits>
#include <numbers>

#include "preprocess/surface/neighbor_blocks.h"

namespace pointrt::surface {
namespace {

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

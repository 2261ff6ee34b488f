// SPDX-License-Identifier: GPL-3.0-or-later
#include "preprocess/surface/orient_tree.h"

#include <algorithm>
#include <cmath>
#include <tbb/parallel_for.h>
#include <tbb/parallel_sort.h>

#include "preprocess/surface/components.h"

namespace pointrt::surface {
namespace {

// An edge is one number that sorts by weight: the weight in 2^24 steps above the slot of lists.indices that holds it.
// 40 bits hold the slots of 2^31 points with 255 neighbours each.
constexpr int kSlotBits = 40;
constexpr double kWeightSteps = (1 << 24) - 1;

std::uint64_t edgeOf(const Points& points, std::size_t a, std::uint32_t b, std::size_t slot) {
    const double agreement = std::min(1.0, std::abs(double(points.normals[a].dot(points.normals[b]))));
    return std::uint64_t((1 - agreement) * kWeightSteps) << kSlotBits | slot;
}

/// Whether the edge from point to its neighbour is left to the neighbour's own list.
bool listedByNeighbor(const NeighborLists& lists, std::size_t point, std::uint32_t neighbor) {
    if (point < neighbor) return false;
    const auto theirs = lists.of(neighbor);
    return std::find(theirs.begin(), theirs.end(), std::uint32_t(point)) != theirs.end();
}

/// Calls body(neighbor, slot) for the edges that point contributes.
template <typename Body>
void forEdges(const NeighborLists& lists, std::size_t point, const Body& body) {
    for (std::size_t slot = point * lists.k; slot < (point + 1) * lists.k; ++slot)
        if (!listedByNeighbor(lists, point, lists.indices[slot])) body(lists.indices[slot], slot);
}

/// Every edge of the graph once, lightest first.
std::vector<std::uint64_t> sortedEdges(const Points& points, const NeighborLists& lists) {
    std::vector<std::size_t> first(points.size() + 1, 0);
    tbb::parallel_for(std::size_t(0), points.size(),
                      [&](std::size_t i) { forEdges(lists, i, [&](std::uint32_t, std::size_t) { ++first[i + 1]; }); });
    for (std::size_t i = 0; i < points.size(); ++i) first[i + 1] += first[i];
    std::vector<std::uint64_t> edges(first.back());
    tbb::parallel_for(std::size_t(0), points.size(), [&](std::size_t i) {
        std::size_t next = first[i];
        forEdges(lists, i,
                 [&](std::uint32_t neighbor, std::size_t slot) { edges[next++] = edgeOf(points, i, neighbor, slot); });
    });
    tbb::parallel_sort(edges);
    return edges;
}

} // namespace

void orientByKruskal(Points& points, const NeighborLists& lists, const std::vector<std::uint8_t>& sources) {
    ParitySets tree(points.size() + 1);
    const auto root = std::uint32_t(points.size()); // stands for all that is known
    for (std::uint32_t i = 0; i < root; ++i)
        if (sources[i]) tree.join(root, i, false);

    constexpr std::uint64_t kSlotMask = (std::uint64_t(1) << kSlotBits) - 1;
    for (const std::uint64_t edge : sortedEdges(points, lists)) {
        const std::size_t slot = edge & kSlotMask;
        const auto a = std::uint32_t(slot / lists.k), b = lists.indices[slot];
        tree.join(a, b, points.normals[a].dot(points.normals[b]) < 0);
    }

    const bool root_flipped = tree.find(root).second;
    for (std::uint32_t i = 0; i < root; ++i)
        if (tree.find(i).second != root_flipped) points.normals[i] = -points.normals[i];
}

} // namespace pointrt::surface

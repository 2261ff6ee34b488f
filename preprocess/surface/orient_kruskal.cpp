// SPDX-License-Identifier: GPL-3.0-or-later
#include "preprocess/cloud/per_thread.h"
#include "preprocess/surface/orient_tree.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>
#include <tbb/parallel_sort.h>

#include "preprocess/surface/components.h"

namespace pointrt::surface {
namespace {

/// Compares the normal at one end of an edge, reflected in the plane that bisects the edge, with that at the other end.
struct Reflection {
    float cosine; ///< of the normals as they are
    float scaled; ///< of the reflected one, times length_squared
    float length_squared;

    /// The edge leaves the surface by more than 27 degrees: reflection reduces the cosine to less than 0.6 of it.
    bool isOblique() const { return scaled * cosine < 0.6f * cosine * cosine * length_squared; }
    /// The edge joins two sheets: similar normals, but one point is behind the other.
    bool joinsSheets() const { return scaled * cosine < 0 && std::abs(cosine) > 0.5f; }
};

Reflection reflectionOf(const PointSet& points, std::size_t a, std::size_t b) {
    const Vec3f edge = points.positions[b] - points.positions[a];
    const float cosine = points.normals[a].dot(points.normals[b]), squared = edge.squaredNorm();
    return {cosine, cosine * squared - 2 * edge.dot(points.normals[a]) * edge.dot(points.normals[b]), squared};
}

// An edge is one number that sorts by weight: the weight in 2^24 steps, above the slot of lists.indices that holds it.
// 40 bits hold the slots of 2^31 points with 255 neighbours each.
constexpr int kSlotBits = 40;
constexpr double kWeightSteps = (1 << 24) - 1;

/// The graph whose tree is sought.
struct Graph {
    const PointSet& points;
    const NeighborLists& lists;
    const EdgeKinds& kinds;

    /// Uses only the normals if the edge lies in the surface, which avoids reading positions.
    Agreement agreement(std::size_t a, std::uint32_t b) const {
        if (kinds.oblique[a] || kinds.oblique[b]) return agreementOf(points, a, b);
        const float cosine = points.normals[a].dot(points.normals[b]);
        return {std::abs(cosine), cosine < 0};
    }
};

std::uint64_t edgeOf(const Graph& graph, std::size_t a, std::uint32_t b, std::size_t slot) {
    const double agreement = std::min(1.0, double(graph.agreement(a, b).sure));
    return std::uint64_t((1 - agreement) * kWeightSteps) << kSlotBits | slot;
}

/// Whether the edge between point and its neighbour is taken from the neighbour's list.
bool listedByNeighbor(const NeighborLists& lists, std::size_t point, std::uint32_t neighbor) {
    if (point < neighbor) return false;
    const auto theirs = lists.of(neighbor);
    return std::find(theirs.begin(), theirs.end(), std::uint32_t(point)) != theirs.end();
}

/// Quantiles at which the sorted edges are cut into parts, only one of which is in memory at a time. For sampled meshes
/// and raw range scans no part holds more than 2 or 3 of the 10 edges per point: most edges of later parts are left
/// out, because their points are in one set already.
constexpr double kCuts[] = {0.25, 0.5, 0.75};

/// The upper bound of each part: the quantiles of the edges of one point in 64, and a bound of all edges.
std::vector<std::uint64_t> cutEdges(const Graph& graph) {
    const NeighborLists& lists = graph.lists;
    constexpr std::size_t kStep = 64;
    std::vector<std::uint64_t> sample;
    for (std::size_t i = 0; i < graph.points.size(); i += kStep)
        for (std::size_t slot = i * lists.k; slot < (i + 1) * lists.k; ++slot)
            sample.push_back(edgeOf(graph, i, lists.indices[slot], slot));
    std::sort(sample.begin(), sample.end());
    std::vector<std::uint64_t> cuts;
    for (const double cut : kCuts) cuts.push_back(sample[std::size_t(cut * double(sample.size()))]);
    cuts.push_back(~std::uint64_t(0));
    return cuts;
}

/// The edges in [from, to) that join two sets of tree, each once, lightest first.
std::vector<std::uint64_t> joiningEdges(const Graph& graph, const ParitySets& tree, std::uint64_t from,
                                        std::uint64_t to) {
    const NeighborLists& lists = graph.lists;
    tbb::enumerable_thread_specific<std::vector<std::uint64_t>> found;
    tbb::parallel_for(tbb::blocked_range<std::size_t>(0, graph.points.size()), [&](const auto& range) {
        std::vector<std::uint64_t>& mine = found.local();
        for (std::size_t slot = range.begin() * lists.k; slot < range.end() * lists.k; ++slot) {
            const std::size_t point = slot / lists.k;
            const std::uint32_t neighbor = lists.indices[slot];
            if (tree.rootOf(std::uint32_t(point)) == tree.rootOf(neighbor)) continue;
            const std::uint64_t edge = edgeOf(graph, point, neighbor, slot);
            if (edge >= from && edge < to && !listedByNeighbor(lists, point, neighbor)) mine.push_back(edge);
        }
    });
    std::size_t count = 0;
    for (const std::vector<std::uint64_t>& part : found) count += part.size();
    std::vector<std::uint64_t> edges;
    edges.reserve(count);
    for (std::vector<std::uint64_t>& part : found) {
        edges.insert(edges.end(), part.begin(), part.end());
        std::vector<std::uint64_t>().swap(part);
    }
    tbb::parallel_sort(edges);
    return edges;
}

void joinAlong(const std::vector<std::uint64_t>& edges, const Graph& graph, ParitySets& tree) {
    constexpr std::uint64_t kSlotMask = (std::uint64_t(1) << kSlotBits) - 1;
    for (const std::uint64_t edge : edges) {
        const std::size_t slot = edge & kSlotMask;
        const auto a = std::uint32_t(slot / graph.lists.k), b = graph.lists.indices[slot];
        tree.join(a, b, graph.agreement(a, b).opposite);
    }
    tree.flatten();
}

} // namespace

Agreement agreementOf(const PointSet& points, std::size_t a, std::size_t b) {
    // Edges that join two sheets, or seem to because of noise, are weighted by this factor, so that edges along a
    // surface come before them: these weigh less only where they leave the surface's plane by 25 degrees (cos^2 of
    // twice that is 0.4). Edges from sheet to sheet across a corner weigh less still, and come last.
    constexpr float kBetween = 0.4f;
    const Reflection reflection = reflectionOf(points, a, b);
    const float reflected = reflection.scaled / reflection.length_squared;
    return {(reflection.joinsSheets() ? kBetween : 1) * reflected * reflected, reflected < 0, reflection.joinsSheets()};
}

EdgeKinds edgeKinds(const PointSet& points, const NeighborLists& lists) {
    EdgeKinds kinds{std::vector<std::uint8_t>(points.size(), 0)};
    std::atomic<bool> sheets = false;
    tbb::parallel_for(tbb::blocked_range<std::size_t>(0, points.size()), [&](const auto& range) {
        bool found = false;
        for (std::size_t i = range.begin(); i < range.end(); ++i)
            for (const std::uint32_t neighbor : lists.of(i)) {
                const Reflection reflection = reflectionOf(points, i, neighbor);
                kinds.oblique[i] |= reflection.isOblique();
                found |= reflection.joinsSheets();
            }
        if (found) sheets = true;
    });
    kinds.sheets = sheets;
    return kinds;
}

void orientByKruskal(PointSet& points, const NeighborLists& lists, const EdgeKinds& kinds,
                     const std::vector<std::uint8_t>& sources) {
    const Graph graph{points, lists, kinds};
    ParitySets tree(points.size() + 1);
    const auto root = std::uint32_t(points.size()); // represents all known sides
    for (std::uint32_t i = 0; i < root; ++i)
        if (sources[i]) tree.join(root, i, false);

    std::uint64_t from = 0;
    for (const std::uint64_t to : cutEdges(graph)) {
        joinAlong(joiningEdges(graph, tree, from, to), graph, tree);
        from = to;
    }

    const bool root_flipped = tree.find(root).second;
    for (std::uint32_t i = 0; i < root; ++i)
        if (tree.find(i).second != root_flipped) points.normals[i] = -points.normals[i];
}

} // namespace pointrt::surface

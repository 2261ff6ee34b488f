// SPDX-License-Identifier: GPL-3.0-or-later
// A kd-tree over points: the nearest ones, and all within a radius.
#pragma once

#include <array>
#include <cstdint>
#include <limits>
#include <span>
#include <vector>

#include "preprocess/cloud/cloud.h"

namespace pointrt::surface {

/// A kd-tree over a copy of positions. It divides and visits them in the order of FLANN's KDTreeSingleIndex, in half
/// the time: it is built on all threads, measures the points of a leaf at once and calls no virtual functions. Searches
/// are exact and may run on any number of threads at once; among equally distant points, the lower index comes first,
/// unless more points than wanted are at the very place.
class NearestSearch {
public:
    explicit NearestSearch(const std::vector<Vec3f>& positions);

    /// Finds the points nearest to query, nearest first, at most as many as fit into indices, with squared distances
    /// below squared_limit. squared_distances is as long as indices. Returns their number.
    std::size_t nearest(const Vec3f& query, std::span<std::uint32_t> indices, std::span<float> squared_distances,
                        float squared_limit = std::numeric_limits<float>::max()) const;

    /// Finds all points nearer to query than the root of squared_radius. Their order depends on query and positions
    /// alone. Returns their number, or indices.size() + 1 if they do not fit: then some are missing.
    std::size_t within(const Vec3f& query, float squared_radius, std::span<std::uint32_t> indices) const;

    /// The first half of a node's points follows it, the second is so many nodes on.
    struct Node {
        float low = 0, high = 0; ///< along axis, the first half ends at low and the second begins at high
        std::uint32_t axis = 0;
        std::uint32_t second = 0;         ///< 0: a leaf
        std::uint32_t begin = 0, end = 0; ///< a leaf's points
    };
    struct Box {
        Vec3f low, high;
    };
    /// The positions, one array an axis, and where they were in the input.
    struct Columns {
        std::array<std::vector<float>, 3> axes;
        std::vector<std::uint32_t> indices;
    };

private:
    struct Query;

    template <typename Found>
    void search(const Vec3f& place, Found& found) const;
    template <typename Found>
    void visit(const Node* node, float squared, Query& query, Found& found) const;
    template <typename Found>
    void visitLeaf(const Node& leaf, const Vec3f& place, Found& found) const;

    Columns columns_;
    std::vector<Node> nodes_;
    Box box_;
};

} // namespace pointrt::surface

// SPDX-License-Identifier: GPL-3.0-or-later
// Union-find over points, with parity to orient normals.
#pragma once

#include <cstdint>
#include <utility>
#include <vector>

namespace pointrt::surface {

/// Disjoint sets of points, each with a flag whether it is flipped relative to its set's root.
class ParitySets {
public:
    explicit ParitySets(std::size_t count);

    /// The root of a point's set, and whether the point is flipped relative to it.
    std::pair<std::uint32_t, bool> find(std::uint32_t point);
    /// Joins the sets of a and b so that b is flipped relative to a as given. Returns false and changes nothing if they
    /// are in the same set.
    bool join(std::uint32_t a, std::uint32_t b, bool flipped);
    /// Makes every point a child of its root, so that rootOf takes one step.
    void flatten();
    /// As find, but without path compression: any number of threads may call it at once.
    std::uint32_t rootOf(std::uint32_t point) const {
        while (parent_[point] != point) point = parent_[point];
        return point;
    }

private:
    std::vector<std::uint32_t> parent_; ///< a root is its own parent
    std::vector<std::uint8_t> flipped_; ///< relative to the parent
    std::vector<std::uint8_t> rank_;
};

/// Connected components of a graph, each named by its lowest point. Any number of threads may join at once.
class SharedSets {
public:
    explicit SharedSets(std::size_t count);

    void join(std::uint32_t a, std::uint32_t b);
    /// The lowest point of the set, once all threads are done joining.
    std::uint32_t find(std::uint32_t point);

private:
    std::vector<std::uint32_t> parent_; ///< lower than the point; a root is its own parent
};

} // namespace pointrt::surface

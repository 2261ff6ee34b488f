// SPDX-License-Identifier: GPL-3.0-or-later
// Union-find over points, with the parity that makes it orient normals.
#pragma once

#include <cstdint>
#include <utility>
#include <vector>

namespace pointrt::surface {

/// Sets of points, each point knowing whether it is flipped against its set's root.
class ParitySets {
public:
    explicit ParitySets(std::size_t count);

    /// The root of a point's set, and whether the point is flipped against it.
    std::pair<std::uint32_t, bool> find(std::uint32_t point);
    /// Joins the sets of a and b so that b is flipped against a exactly when flipped says so; false, and nothing
    /// done, when they are in one set already.
    bool join(std::uint32_t a, std::uint32_t b, bool flipped);
    /// Hangs every point under its root, so that rootOf takes one step.
    void flatten();
    /// As find, without shortening the way: any number of threads may ask at once.
    std::uint32_t rootOf(std::uint32_t point) const {
        while (parent_[point] != point) point = parent_[point];
        return point;
    }

private:
    std::vector<std::uint32_t> parent_; ///< of a root: itself
    std::vector<std::uint8_t> flipped_; ///< against the parent
    std::vector<std::uint8_t> rank_;
};

/// The connected component of each point of a graph, as the lowest point in it. Built by any number of threads at once.
class SharedSets {
public:
    explicit SharedSets(std::size_t count);

    void join(std::uint32_t a, std::uint32_t b);
    /// The lowest point of the set, once no thread joins any more.
    std::uint32_t find(std::uint32_t point);

private:
    std::vector<std::uint32_t> parent_; ///< lower than the point; of a root: itself
};

} // namespace pointrt::surface

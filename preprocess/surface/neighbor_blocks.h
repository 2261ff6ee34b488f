// SPDX-License-Identifier: GPL-3.0-or-later
// The nearest points of many points at once.
#pragma once

#include <cstdint>
#include <limits>
#include <vector>

#include "preprocess/surface/neighbors.h"

namespace pointrt::surface {

/// Finds lists of neighbours for runs of points. Points that follow each other on the curve lie together: one search
/// fetches what is round all of them, and of that each takes its nearest. The lists are those of single searches, in
/// 3/5 of their time. One object a thread.
class BlockSearch {
public:
    BlockSearch(const Points& points, const NearestSearch& search, NeighborLists& lists);

    /// Fills lists.indices of the points in [begin, end).
    void fill(std::size_t begin, std::size_t end);

private:
    /// Candidates as arrays, which compilers turn into vector instructions.
    struct Candidates {
        std::vector<std::uint32_t> indices;
        std::vector<float> x, y, z;
        std::size_t count = 0;
    };

    void fillBlock(std::size_t begin, std::size_t end);
    void fillAlone(std::size_t point);
    bool fetch(const Vec3f& center, float radius);
    void measure(const Vec3f& from);
    void keepWithin(float squared_radius);
    void thinKept(float squared_radius);
    void sortKept();
    void storeKept(std::size_t point);
    float reachByWindow(const Vec3f& center, std::size_t begin, std::size_t end);

    const Points& points_;
    const NearestSearch& search_;
    NeighborLists& lists_;
    std::size_t wanted_; ///< neighbours and the point itself
    /// Distance of the point last filled to its last neighbour, infinite before the first.
    float reach_ = std::numeric_limits<float>::infinity();
    Candidates near_;
    std::vector<float> squared_; ///< of near_, from one point
    std::vector<float> kept_, sorted_;
    std::vector<std::uint32_t> kept_indices_, sorted_indices_;
    std::vector<std::uint16_t> used_; ///< of each rank, how many have it
    std::size_t kept_count_ = 0;
    std::vector<float> window_;
};

} // namespace pointrt::surface

// SPDX-License-Identifier: GPL-3.0-or-later
// Nearest neighbours: a kd-tree, and the lists of all points' neighbours that the later stages share.
#pragma once

#include <cmath>
#include <cstdint>
#include <limits>
#include <memory>
#include <new>
#include <span>
#include <utility>
#include <vector>

#include "preprocess/surface/points.h"
#include "preprocess/surface/stages.h"

namespace pointrt::surface {

/// Squared distance, its sum in the order of the search: the same bits.
inline float squaredDistance(const Vec3f& a, const Vec3f& b) {
    const float x = a.x() - b.x(), y = a.y() - b.y(), z = a.z() - b.z();
    return x * x + y * y + z * z;
}

inline float distanceBetween(const Vec3f& a, const Vec3f& b) { return std::sqrt(squaredDistance(a, b)); }

/// FLANN's single kd-tree over positions, which must stay unchanged while it lives. Searches are exact and may run on
/// any number of threads at once; of equally distant points the lower index comes first.
class NearestSearch {
public:
    explicit NearestSearch(const std::vector<Vec3f>& positions);
    ~NearestSearch();
    NearestSearch(NearestSearch&&) noexcept;
    NearestSearch& operator=(NearestSearch&&) noexcept;

    /// The points nearest to query, nearest first, at most as many as fit into indices.
    /// squared_distances is as long as indices; all are below squared_limit. Returns how many there are.
    std::size_t nearest(const Vec3f& query, std::span<std::uint32_t> indices, std::span<float> squared_distances,
                        float squared_limit = std::numeric_limits<float>::max()) const;

    /// All points nearer to query than the root of squared_radius, in no order. Returns how many there are, or
    /// indices.size() + 1 when they do not fit: some are missing then.
    std::size_t within(const Vec3f& query, float squared_radius, std::span<std::uint32_t> indices) const;

private:
    struct Tree;
    std::unique_ptr<Tree> tree_;
};

/// Leaves new numbers unset: the threads that fill a large array are then also those that first touch its memory.
template <typename T>
struct UnsetAllocator : std::allocator<T> {
    template <typename U>
    void construct(U* at) {
        ::new (static_cast<void*>(at)) U;
    }
    template <typename U, typename... Arguments>
    void construct(U* at, Arguments&&... arguments) {
        ::new (static_cast<void*>(at)) U(std::forward<Arguments>(arguments)...);
    }
    template <typename U>
    struct rebind {
        using other = UnsetAllocator<U>;
    };
};

/// The k neighbours of every point that stand for its surroundings, nearest first, without the point itself:
/// the nearest, or a thinned choice of the nearer ones where the nearest lie on a line (spreadLines).
struct NeighborLists {
    std::size_t k = 0;
    std::vector<std::uint32_t, UnsetAllocator<std::uint32_t>> indices; ///< [points][k]
    std::vector<float> spacings;       ///< [points], edge of the square that a point has to itself; half the way to
                                       ///< the next scan line where the list is thinned
    std::vector<std::uint8_t> thinned; ///< [points], 1: of the second half only some are listed

    std::span<const std::uint32_t> of(std::size_t point) const { return {&indices[point * k], k}; }
    /// Distance of a point to its neighbour at a place of its list. Not stored: it would be as much as the indices.
    float distance(const Points& points, std::size_t point, std::size_t place) const {
        return distanceBetween(points.positions[point], points.positions[indices[point * k + place]]);
    }
    /// Distance to the last neighbour.
    float reach(const Points& points, std::size_t point) const { return distance(points, point, k - 1); }
    /// Within this distance every point is on the list.
    float completeReach(const Points& points, std::size_t point) const {
        return distance(points, point, thinned[point] ? k / 2 : k - 1);
    }
};

/// Edge of the square that a point has to itself when its count nearest neighbours, the farthest at distance reach,
/// are spread evenly over a plane.
float spacingFromReach(float reach, std::size_t count);

/// Finds k neighbours of every point, or all others in smaller clouds (of at least 2 points).
NeighborLists findNeighbors(const Points& points, const NearestSearch& search, std::size_t k, const StageShare& share);

/// After keepPoints(keep): renumbers the lists, and finds those anew that held a point now gone.
/// search is over the points that are left.
/// All lists are of nearest neighbours still: call it before spreadLines.
void keepNeighbors(NeighborLists& lists, const std::vector<std::uint8_t>& keep, const Points& points,
                   const NearestSearch& search);

} // namespace pointrt::surface

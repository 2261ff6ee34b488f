// SPDX-License-Identifier: GPL-3.0-or-later
// Nearest neighbours: a kd-tree, and neighbour lists of all points, which later stages share.
#pragma once

#include <cmath>
#include <cstdint>
#include <limits>
#include <memory>
#include <new>
#include <span>
#include <utility>
#include <vector>

#include "preprocess/surface/parallel_stages.h"
#include "preprocess/surface/point_set.h"

namespace pointrt::surface {

/// Squared distance, summed in FLANN's order, so that the bits are the same.
inline float squaredDistance(const Vec3f& a, const Vec3f& b) {
    const float x = a.x() - b.x(), y = a.y() - b.y(), z = a.z() - b.z();
    return x * x + y * y + z * z;
}

inline float distanceBetween(const Vec3f& a, const Vec3f& b) { return std::sqrt(squaredDistance(a, b)); }

/// FLANN's single kd-tree over positions, which must outlive it unchanged. Searches are exact and may run on any number
/// of threads at once; among equally distant points, the lower index comes first.
class NearestSearch {
public:
    explicit NearestSearch(const std::vector<Vec3f>& positions);
    ~NearestSearch();
    NearestSearch(NearestSearch&&) noexcept;
    NearestSearch& operator=(NearestSearch&&) noexcept;

    /// Finds the points nearest to query, nearest first, at most as many as fit into indices, with squared distances
    /// below squared_limit. squared_distances is as long as indices. Returns their number.
    std::size_t nearest(const Vec3f& query, std::span<std::uint32_t> indices, std::span<float> squared_distances,
                        float squared_limit = std::numeric_limits<float>::max()) const;

    /// Finds all points nearer to query than the root of squared_radius, in any order. Returns their number, or
    /// indices.size() + 1 if they do not fit: then some are missing.
    std::size_t within(const Vec3f& query, float squared_radius, std::span<std::uint32_t> indices) const;

private:
    struct Tree;
    std::unique_ptr<Tree> tree_;
};

/// Leaves new elements uninitialised, so that the threads that fill a large array also touch its memory first.
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

/// Flags of a list whose second half holds points of a wider neighbourhood, not the nearest (surroundNeighborhoods).
enum ListFlag : std::uint8_t {
    kThinned = 1,
    kOpen = 2,      ///< at a border: they leave a side open
    kClump = 4,     ///< the nearest are in a clump, not on a line
    kAtGap = 8,     ///< the nearest are on one side, the others all around: beyond a gap of the sampling
    kBesideGap = 16 ///< on a line without gaps of its own, many steps from the next ones
};

/// The k neighbours of every point, nearest first, without the point itself.
struct NeighborLists {
    std::size_t k = 0;
    std::vector<std::uint32_t, UnsetAllocator<std::uint32_t>> indices; ///< [points][k]
    std::vector<float> spacings;       ///< [points], edge of the square that a point has to itself; half the distance
                                       ///< to the farthest point around if the list is not of the nearest
    std::vector<std::uint8_t> thinned; ///< [points], ListFlag; 0: the nearest

    std::span<const std::uint32_t> of(std::size_t point) const { return {&indices[point * k], k}; }
    /// Distance of a point to its neighbour at a place of its list. Not stored: that would take as much as the indices.
    float distance(const PointSet& points, std::size_t point, std::size_t place) const {
        return distanceBetween(points.positions[point], points.positions[indices[point * k + place]]);
    }
    /// Radius of the neighbourhood: the distance to the last neighbour.
    float radius(const PointSet& points, std::size_t point) const { return distance(points, point, k - 1); }
    /// Number of nearest neighbours at the start of a list whose second half is wider (ListFlag).
    std::size_t denseCount() const { return k / 2 + 1; }
    /// Every point within this distance is on the list.
    float completeRadius(const PointSet& points, std::size_t point) const {
        return distance(points, point, (thinned[point] ? denseCount() : k) - 1);
    }
};

/// Edge of the square that each point has to itself if a point's count nearest neighbours, the farthest at distance
/// radius, are spread evenly over a plane.
float spacingFromRadius(float radius, std::size_t count);

/// Finds the k nearest neighbours of every point, or all other points if there are fewer than k. Needs at least 2
/// points.
NeighborLists findNeighbors(const PointSet& points, const NearestSearch& search, std::size_t k,
                            const StageShare& share);

/// After keepRows(points, keep): renumbers the lists, and replaces those that held a dropped point by lists of nearest
/// neighbours. search covers the remaining points.
void keepNeighbors(NeighborLists& lists, const std::vector<std::uint8_t>& keep, const PointSet& points,
                   const NearestSearch& search);

} // namespace pointrt::surface

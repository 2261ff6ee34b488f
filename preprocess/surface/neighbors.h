// SPDX-License-Identifier: GPL-3.0-or-later
// Nearest neighbours: a kd-tree, and the lists of all points' neighbours that the later stages share.
#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "preprocess/surface/points.h"
#include "preprocess/surface/stages.h"

namespace pointrt::surface {

/// FLANN's single kd-tree over positions, which must stay unchanged while it lives. Searches are exact and may run on
/// any number of threads at once; of equally distant points the lower index comes first.
class NearestSearch {
public:
    explicit NearestSearch(const std::vector<Vec3f>& positions);
    ~NearestSearch();
    NearestSearch(NearestSearch&&) noexcept;
    NearestSearch& operator=(NearestSearch&&) noexcept;

    /// The points nearest to query, nearest first, at most as many as fit into indices.
    /// squared_distances is as long as indices. Returns how many there are.
    std::size_t nearest(const Vec3f& query, std::span<std::uint32_t> indices, std::span<float> squared_distances) const;

private:
    struct Tree;
    std::unique_ptr<Tree> tree_;
};

/// The k neighbours of every point that stand for its surroundings, nearest first, without the point itself:
/// the nearest, or a thinned choice of the nearer ones where the nearest lie on a line (spreadLines).
struct NeighborLists {
    std::size_t k = 0;
    std::vector<std::uint32_t> indices; ///< [points][k]
    std::vector<float> distances;       ///< [points][k], in the unit of positions
    std::vector<float> spacings;        ///< [points], edge of the square that a point has to itself; half the way to
                                        ///< the next scan line where the list is thinned
    std::vector<std::uint8_t> thinned;  ///< [points], 1: of the second half only some are listed

    std::span<const std::uint32_t> of(std::size_t point) const { return {&indices[point * k], k}; }
    std::span<const float> distancesOf(std::size_t point) const { return {&distances[point * k], k}; }
    /// Distance to the last neighbour.
    float reach(std::size_t point) const { return distances[point * k + k - 1]; }
    /// Within this distance every point is on the list.
    float completeReach(std::size_t point) const {
        return thinned[point] ? distances[point * k + k / 2] : reach(point);
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

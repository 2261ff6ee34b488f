// SPDX-License-Identifier: GPL-3.0-or-later
// Neighbourhoods that surround their points, where the nearest neighbours are on a line or in a clump.
#pragma once

#include "preprocess/surface/neighbors.h"

namespace pointrt::surface {

/// A sample of a cloud's lists, from which to decide whether some are to be replaced.
struct SurroundCounts {
    std::size_t sampled = 0;
    std::size_t unsurrounded = 0; ///< on a line or in a clump
    std::size_t isolated = 0;     ///< with little around
    std::size_t probed = 0;       ///< whose wider surroundings were examined, too
    std::size_t noisy = 0;        ///< of those: in a surface blurred by noise wider than the list
    std::size_t at_gaps = 0;      ///< of those: at the edge of a gap that has surface on its far side
    std::vector<float> reaches;   ///< [sampled] distance to the k-th neighbour, input units
};

void addCounts(SurroundCounts& counts, const SurroundCounts& more);

/// Adds those of a cloud, or of a place in it. Samples nothing for fewer than 8 neighbours.
/// @param inner [points] 1: the neighbourhood is complete, as of SurfaceDecisions; only these count
void countUnsurrounded(const NeighborLists& lists, const PointSet& points, const NearestSearch& nearest,
                       const std::vector<std::uint8_t>& inner, SurroundCounts& counts);

/// How a cloud is thinned, and whether its neighbour lists are searched again.
struct Thinning {
    float finest_cells = 0;      ///< edge, input units: as wide as all but the smallest lists; 0: no thinned clouds
    bool replaces_lists = false; ///< false: hardly any list is to be replaced
    bool is_noisy = false;       ///< noise is as wide as many lists: their planes are those of the noise
    bool has_gaps = false;       ///< many points are beside gaps of the sampling: it is in bands
};
Thinning thinningOf(SurroundCounts counts);

/// Replaces the farther half of the lists of points whose nearest neighbours do not surround them because they are on a
/// line, as in the sweep of a lidar, or in a clump, as in merged frames of a stationary sensor. In noisy clouds, also
/// replaces those of points whose neighbours are in no plane, at the scale at which the points around are in one.
/// Replacements come from thinned clouds with cells that double in width, in which a clump counts as one point, until
/// they leave no gap of a third of a turn. At a border, where a gap remains at four times the distance, and in corners,
/// takes points many of which have such lists themselves. Leaves lists for which there is no plane (a wire), those on a
/// line that stands across the plane of the points around (posts, and trunks that several beams of a lidar have met),
/// and those at borders of even samplings. Sets thinned and the spacings of these lists. Does nothing for fewer than 8
/// neighbours.
/// @param thinning finest_cells in the unit of the points; 0: replaces no list
void surroundNeighborhoods(NeighborLists& lists, const PointSet& points, const NearestSearch& nearest,
                           const Thinning& thinning, const StageShare& share);

} // namespace pointrt::surface

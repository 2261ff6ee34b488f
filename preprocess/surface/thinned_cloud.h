// SPDX-License-Identifier: GPL-3.0-or-later
// Thinned copies of a cloud: one point for each cell of grids whose cells double in width.
#pragma once

#include <cstdint>
#include <vector>

#include "preprocess/surface/neighbors.h"

namespace pointrt::surface {

/// The points that stand for the cells of one grid: in each, the one nearest to the mean of all its points. A clump of
/// points counts as one, and its representative has little of their noise.
struct ThinnedLevel {
    float edge = 0;                    ///< of a cell
    std::vector<std::uint32_t> points; ///< indices of the representatives
    std::vector<std::uint32_t> first;  ///< [cells + 1], begin of each cell's points in ThinnedCloud::order
    std::vector<Vec3f> positions;      ///< of the representatives
    NearestSearch search;              ///< over positions
};

/// Thinned levels of a cloud, finest first, each with cells twice as wide as those of the level before.
class ThinnedCloud {
public:
    /// @param finest requested edge of the finest cells, above 0; rounded down to a power of two, so that the cells do
    /// not depend on the scale of the points
    ThinnedCloud(const PointSet& points, float finest);

    std::size_t levelCount() const { return levels_.size(); }
    const ThinnedLevel& level(std::size_t number) const { return levels_[number]; }
    /// The finest level whose cells are at least this wide; levelCount() if all are narrower.
    std::size_t levelFor(float edge) const;

    /// [points] bit n: the point's cell of level n is surrounded by nothing, or only by a line. The 12th representative
    /// is more than 4.5 cell edges away: 1.8 on a surface, 3.5 at a corner of one, 6 on a line.
    std::vector<std::uint32_t> findIsolated() const;

private:
    std::vector<std::uint32_t> order_; ///< the points in the order of the cells
    std::vector<ThinnedLevel> levels_;
};

} // namespace pointrt::surface

// SPDX-License-Identifier: GPL-3.0-or-later
// Radius coding of a level: the same in all of its tiles, so that a splat has the same bits in each of them.
#pragma once

#include <functional>
#include <vector>

#include "preprocess/tiles/tile_tree.h"

namespace pointrt {

/// As in the header of a .pro.
struct LevelCoding {
    float radius_max = 0;  ///< cube units
    float radius_step = 0; ///< octaves
};

/// Radii of a tile's own splats, input units; both 0 if it has none.
struct RadiusRange {
    float least = 0, most = 0;
};

/// The largest radius of a tile's splats over the edge of its core: 1/8 in cube units. A slab then ends 0.28 edges from
/// its centre, within the half edge of the cube around the core.
constexpr double kRadiusPerEdge = 0.25;

/// [levels]. Covers the tiles' own splats and those from neighbours of other levels, which are clamped to
/// kRadiusPerEdge.
/// @param edge of level 0's cores, input units
std::vector<LevelCoding> findLevelCodings(const TileTree& tree, double edge,
                                          const std::function<RadiusRange(const TileKey&)>& range_of);

} // namespace pointrt

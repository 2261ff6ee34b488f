// SPDX-License-Identifier: GPL-3.0-or-later
// Splats of a coarser level: a parent's out of its children's.
#pragma once

#include <limits>
#include <span>

#include "preprocess/tiles/splat_file.h"

namespace pointrt {

/// Of a parent's splats on surfaces over those of its children; fewer where those of a tile would be too many.
constexpr double kMergedShare = 0.25;

/// A child's splats, its own and no others.
struct MergeChild {
    TileKey tile;
    SplatsView splats;
    double error = 0; ///< TileSplats::error
};

/// The parent's own splats (merge_disc.h, merge_values.h). Its error is the children's largest and, above that, the
/// error that 95% of the merged area keep to, but at least a quarter of the spacing: the distance of the surface from
/// its children's, and of theirs from the original splats.
/// @param children in any order, at least one splat in all of them
/// @param schema of the attributes of all children
/// @param tile_splats about so many at the most
/// @param edge of the parent's core, input units
TileSplats mergeSplats(const TileKey& parent, std::vector<MergeChild> children, const std::vector<Attribute>& schema,
                       double edge, std::uint64_t tile_splats, bool oriented);

/// The same from file to file. Children are those that have files. Throws Error.
/// @param widest of the original splats' radii, input units
void mergeTile(const std::string& folder, const TileKey& parent, const std::vector<TileKey>& children, double edge,
               std::uint64_t tile_splats, bool oriented, float widest = std::numeric_limits<float>::infinity());

} // namespace pointrt

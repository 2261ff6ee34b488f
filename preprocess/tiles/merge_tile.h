// SPDX-License-Identifier: GPL-3.0-or-later
// Makes the splats of a coarser level: a parent's from its children's.
#pragma once

#include <limits>
#include <span>

#include "preprocess/tiles/splat_file.h"

namespace pointrt {

/// Number of a parent's splats as a share of its children's, on surfaces; less if a tile would have too many.
constexpr double kMergedShare = 0.25;

/// A child's own splats.
struct MergeChild {
    TileKey tile;
    SplatsView splats;
    double error = 0; ///< see TileSplats::error
};

/// The parent's own splats (merge_disc.h, merge_values.h). Its error, the distance of its surface from the original
/// splats, is the largest error of its children plus the error that 95% of the merged area does not exceed, at least a
/// quarter of the spacing.
/// @param children in any order, with at least one splat in total
/// @param schema of the attributes of all children
/// @param tile_splats approximate limit of splats
/// @param edge of the parent's core, input units
TileSplats mergeSplats(const TileKey& parent, std::vector<MergeChild> children, const std::vector<Attribute>& schema,
                       double edge, std::uint64_t tile_splats, bool oriented);

/// Reads the children's files and writes the result to a file. Throws Error.
/// @param children those that have files
/// @param widest largest radius of original splats, input units
void mergeTile(const std::string& folder, const TileKey& parent, const std::vector<TileKey>& children, double edge,
               std::uint64_t tile_splats, bool oriented, float widest = std::numeric_limits<float>::infinity());

} // namespace pointrt

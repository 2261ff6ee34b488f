// SPDX-License-Identifier: GPL-3.0-or-later
// The last step of a bake in tiles: set.json.
#pragma once

#include <limits>

#include "preprocess/tiles/build_tile.h"

namespace pointrt {

/// How all levels code their radii, from the files of all tiles. Throws Error (kBadInput).
/// @param widest of the original splats' radii, input units
std::vector<LevelCoding> readLevelCodings(const TileTree& tree, double edge, const std::string& splats_folder,
                                          float widest = std::numeric_limits<float>::infinity());

/// Fills in what the tiles tell: rows, levels, attributes with their ranges, bounds and noise of the original splats,
/// and writes set.json. The noise is the median of the original tiles' medians, by their splats. Throws Error.
/// @param set lattice, world, sensors, settings, orientation and input_points
/// @param rows of the tiles that exist, in any order
void finishSet(TileSet& set, const TileTree& tree, const std::vector<LevelCoding>& codings, std::vector<SetTile> rows,
               const SetFolders& folders);

} // namespace pointrt

// SPDX-License-Identifier: GPL-3.0-or-later
// The last step of baking a set: set.json.
#pragma once

#include <limits>

#include "preprocess/tiles/build_tile.h"

namespace pointrt {

/// Radius coding of all levels, from the files of all tiles. Throws Error (kBadInput).
/// @param widest radius of original splats, input units
std::vector<LevelCoding> readLevelCodings(const TileTree& tree, double edge, const std::string& splats_folder,
                                          float widest = std::numeric_limits<float>::infinity());

/// Fills in rows, levels, attributes with their ranges, and bounds and noise of the original splats from the tiles, and
/// writes set.json. The noise is the median of the original tiles' medians, weighted by their splats. Throws Error.
/// @param set with lattice, world, sensors, settings, orientation and input_points
/// @param rows of the tiles that exist, in any order
void finishSet(TileSet& set, const TileTree& tree, const std::vector<LevelCoding>& codings, std::vector<SetTile> rows,
               const SetFolders& folders);

} // namespace pointrt

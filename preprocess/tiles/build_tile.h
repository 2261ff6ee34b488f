// SPDX-License-Identifier: GPL-3.0-or-later
// Builds one tile of a set from splat files.
#pragma once

#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "preprocess/octree/octree.h"
#include "preprocess/tiles/level_coding.h"
#include "preprocess/tiles/tile_tree.h"

namespace pointrt {

struct TileOptions {
    OctreeOptions octree;
    bool prune = true;
    PruneOptions pruning;
    bool index = true;                                     ///< write the tracing index
    std::size_t threads = 0;                               ///< for the index; 0: all
    float widest = std::numeric_limits<float>::infinity(); ///< widest radius of original splats, input units
    float reflectivity = 0;                                ///< of the material, 0 to 1
    std::string metadata = "{}";                           ///< JSON object for META; the tile's key is added
};

/// Folders of a bake.
struct SetFolders {
    std::string set;    ///< NAME.proset, with its folder tiles
    std::string splats; ///< folder of the splat files
};

/// The tiles whose splat files a tile is made from: itself and its neighbours. In one order for the whole set, so that
/// splats at the same position keep their order.
std::vector<TileKey> inputTilesOf(const TileTree& tree, const TileKey& tile);

/// Collects the tile's splats from its file and its neighbours' files, builds the octree and index, replaces the tile's
/// file and returns its row of set.json; nullopt if no splat's centre lies in its core.
/// The bytes depend on the splats and the options only. Throws Error: kBadInput for missing or damaged files,
/// kCannotWrite.
/// @param set its lattice, up, metres, sensors and orientation
/// @param codings [levels]
std::optional<SetTile> buildTile(const TileSet& set, const TileTree& tree, const TileKey& tile,
                                 const std::vector<LevelCoding>& codings, const SetFolders& folders,
                                 const TileOptions& options);

/// The row of a tile that buildTile has written; nullopt if its file is missing or incomplete.
std::optional<SetTile> findTileRow(const SetFolders& folders, const TileKey& tile);

} // namespace pointrt

// SPDX-License-Identifier: GPL-3.0-or-later
// Splat files to one tile of a set.
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
    std::size_t threads = 0;                               ///< of the index; 0: all
    float widest = std::numeric_limits<float>::infinity(); ///< of the original splats' radii, input units
    float reflectivity = 0;                                ///< of the material, 0 to 1
    std::string metadata = "{}"; ///< JSON object that META holds; what tile it is comes on top
};

/// Where a bake keeps things.
struct SetFolders {
    std::string set;    ///< NAME.proset, with its folder tiles
    std::string splats; ///< of the splat files
};

/// The tiles whose splat files a tile is made from: its own and its neighbours'. In one order for the whole set, so
/// that splats of one position keep theirs.
std::vector<TileKey> sourcesOf(const TileTree& tree, const TileKey& tile);

/// Gathers the tile's splats from its file and its neighbours', builds its octree and index, writes it in place of what
/// is there, and returns its row of set.json; nothing where no splat's centre lies in its core.
/// The bytes depend on the splats and the options alone. Throws Error: kBadInput for files missing or damaged,
/// kCannotWrite.
/// @param set its lattice, what it says of up, metres, sensors and orientation
/// @param codings [levels]
std::optional<SetTile> buildTile(const TileSet& set, const TileTree& tree, const TileKey& tile,
                                 const std::vector<LevelCoding>& codings, const SetFolders& folders,
                                 const TileOptions& options);

/// The row of a tile that buildTile has written; nothing where it is not there, or not whole.
std::optional<SetTile> findTileRow(const SetFolders& folders, const TileKey& tile);

} // namespace pointrt

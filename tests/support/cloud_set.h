// SPDX-License-Identifier: Apache-2.0
// Builds a complete tile set from the splats of one cloud in memory.
#pragma once

#include <string>
#include <vector>

#include "preprocess/cloud/splats.h"
#include "preprocess/tiles/build_tile.h"

namespace pointrt::test {

struct CloudSetOptions {
    double edge = 1;                     ///< of the original tiles, a power of two
    std::uint64_t tile_splats = 1000000; ///< approximate maximum for merged tiles
    WorldFrame world;
    std::vector<double> sensors; ///< rows of SENS
    TileOptions tiles;
};

struct CloudSet {
    TileSet set;
    TileTree tree;
    SetFolders folders;
};

/// Writes a tile set to FOLDER, and its splat files to FOLDER.splats. Each splat goes to the original tile whose core
/// contains its centre; coarser tiles are merged up to one root. Throws Error.
/// @param attributes of the cloud's points
CloudSet writeCloudSet(const std::string& folder, const Splats& splats, const std::vector<Attribute>& attributes,
                       const CloudSetOptions& options);

/// The edge, a power of two, for which the number of tiles with splats is nearest to `tiles`.
double edgeForTiles(const Splats& splats, std::size_t tiles);

} // namespace pointrt::test

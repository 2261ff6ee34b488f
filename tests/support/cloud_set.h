// SPDX-License-Identifier: Apache-2.0
// One cloud's splats in memory as a whole tile set.
#pragma once

#include <string>
#include <vector>

#include "preprocess/cloud/splats.h"
#include "preprocess/tiles/build_tile.h"

namespace pointrt::test {

struct CloudSetOptions {
    double edge = 1;                     ///< of the original tiles, a power of two
    std::uint64_t tile_splats = 1000000; ///< of merged tiles about so many at the most
    WorldFrame world;
    std::vector<double> sensors; ///< rows of SENS
    TileOptions tiles;
};

struct CloudSet {
    TileSet set;
    TileTree tree;
    SetFolders folders;
};

/// Writes FOLDER/set.json and its tiles, with the splat files in FOLDER.splats: every splat in the tile whose core
/// holds its centre, merged ones up to one root. Throws Error.
/// @param attributes of the cloud's points
CloudSet writeCloudSet(const std::string& folder, const Splats& splats, const std::vector<Attribute>& attributes,
                       const CloudSetOptions& options);

/// The power of two that comes nearest to so many tiles that hold splats.
double edgeForTiles(const Splats& splats, std::size_t tiles);

} // namespace pointrt::test

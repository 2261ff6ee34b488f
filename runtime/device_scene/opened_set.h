// SPDX-License-Identifier: Apache-2.0
// A tile set that is looked at: what set.json says, and which of its tiles stand for it.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "format/set/tile_set.h"
#include "runtime/device_scene/cut.h"
#include "runtime/scene/scene_description.h"
#include "runtime/util/pixel_size.h"

namespace pointrt {

struct OpenedSet {
    std::string folder;
    TileSet set;
    std::vector<std::vector<std::uint32_t>> children; ///< childrenOf(set)
    std::vector<bool> lost;                           ///< tiles that could not be opened
    std::vector<bool> wanted_unseen;                  ///< CutRequest::wanted_unseen
    TileCut cut;                                      ///< that stands for it
    TileCut wanted;                                   ///< were there memory for it
};

/// Reads set.json and looks at no tile. Throws Error kBadInput as readTileSet does.
OpenedSet openSet(const std::string& folder);

/// Of a tile's file.
std::string tilePath(const OpenedSet& set, std::uint32_t tile);

/// What a camera of the scene sees in pictures of that size of a set that stands there.
CutView cutView(const Placement& placement, const Camera& camera, PixelSize size);

/// Fills set's cut and wanted by request, but for its marks, which are set's.
void chooseCuts(OpenedSet& set, CutRequest request);

} // namespace pointrt

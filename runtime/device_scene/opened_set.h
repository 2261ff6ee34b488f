// SPDX-License-Identifier: Apache-2.0
// An opened tile set: its set.json and its current cut.
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
    std::vector<bool> missing;                        ///< CutRequest::missing
    std::vector<bool> hit_unseen;                     ///< CutRequest::hit_unseen
    TileCut cut;
    TileCut full_cut; ///< the cut without a memory limit
};

/// Reads set.json but no tile. Throws Error kBadInput as readTileSet does.
OpenedSet openSet(const std::string& folder);

/// The path of a tile's file.
std::string tilePath(const OpenedSet& set, std::uint32_t tile);

/// The view of a scene's camera in the coordinates of a placed set, for pictures of this size.
CutView cutView(const Placement& placement, const Camera& camera, PixelSize size);

/// Sets cut and full_cut for a request; uses the set's missing and hit_unseen in place of the request's.
void chooseCuts(OpenedSet& set, CutRequest request);

} // namespace pointrt

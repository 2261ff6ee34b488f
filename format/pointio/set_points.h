// SPDX-License-Identifier: Apache-2.0
// The points of a tile set: the original splats, once each.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "format/pointio/point_columns.h"
#include "format/set/tile_set.h"
#include "pointrt/pro.hpp"

namespace pointrt {

/// As outlineOf has it of a file, for all tiles: bounds, ranges and coordinate system are the set's, values are null.
/// count is what set.json says. Opens a tile. Throws Error as openTile.
PointOutline outlineOf(const TileSet& set, const std::string& folder);

/// Numbers of a tile's splats whose centres lie in its core, in the order of inputOrder.
std::vector<std::uint32_t> coreNumbers(const ProFile& tile);

} // namespace pointrt

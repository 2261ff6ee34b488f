// SPDX-License-Identifier: Apache-2.0
// The points of a tile set: each original splat once.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "format/pointio/point_columns.h"
#include "format/set/tile_set.h"
#include "pointrt/pro.hpp"

namespace pointrt {

/// outlineOf for all tiles: bounds, ranges, coordinate system and count are from set.json, values are null. Opens one
/// tile. Throws Error as openTile.
PointOutline outlineOf(const TileSet& set, const std::string& folder);

/// Indices of a tile's splats with centres in its core, in the order of inputOrder.
std::vector<std::uint32_t> coreNumbers(const ProFile& tile);

} // namespace pointrt

// SPDX-License-Identifier: GPL-3.0-or-later
// Splats as estimated to a tile's own.
#pragma once

#include "preprocess/tiles/tile_splats.h"

namespace pointrt {

/// Those of splats whose flag in kept is 1, along a Morton curve, with radii of at most kRadiusPerEdge. Of splats at
/// one position the first stays that does not fill a gap, or the first one. spacing is found, error is 0.
/// @param attributes of the cloud's points, as splats.input_index numbers them
/// @param codes [splats], codeOf as seen from the tile
TileSplats takeSplats(const Splats& splats, const std::vector<Attribute>& attributes,
                      const std::vector<PositionCode>& codes, const std::vector<std::uint8_t>& kept, double edge);

/// [splats]
std::vector<PositionCode> codesOf(const TileSet& set, const TileKey& tile, const Splats& splats);

} // namespace pointrt

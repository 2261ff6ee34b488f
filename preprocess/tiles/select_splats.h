// SPDX-License-Identifier: GPL-3.0-or-later
// Selects a tile's own splats from those estimated.
#pragma once

#include "preprocess/tiles/tile_splats.h"

namespace pointrt {

/// The splats whose flag in kept is 1, along a Morton curve, with radii limited to kRadiusPerEdge. If
/// several splats have the same position, keeps the first that does not fill a gap, or else the first one. Computes
/// spacing; error is 0.
/// @param attributes of the cloud's points, indexed by splats.input_index
/// @param codes [splats], codeOf relative to the tile
TileSplats selectSplats(const Splats& splats, const std::vector<Attribute>& attributes,
                        const std::vector<PositionCode>& codes, const std::vector<std::uint8_t>& kept, double edge);

/// Indices of all codes along the same curve.
std::vector<std::uint32_t> orderAlongCurve(const std::vector<PositionCode>& codes);

/// [splats]
std::vector<PositionCode> codesOf(const TileSet& set, const TileKey& tile, const Splats& splats);

} // namespace pointrt

// SPDX-License-Identifier: GPL-3.0-or-later
// Positions as whole steps of a level's lattice, which all tiles of the level share.
#pragma once

#include <array>
#include <compare>
#include <cstdint>
#include <optional>
#include <string>

#include "format/set/tile_set.h"
#include "pointrt/pro_layout.h"
#include "preprocess/cloud/cloud.h"

namespace pointrt {

/// Names a tile of a set.
struct TileKey {
    std::uint32_t level = 0;
    TileCell cell{};
    auto operator<=>(const TileKey&) const = default;
};

inline TileKey keyOf(const SetTile& tile) { return {tile.level, tile.cell}; }
inline TileKey parentOf(const TileKey& key) { return {key.level + 1, parentOf(key.cell)}; }
/// "L-X-Y-Z", of which files are named.
std::string nameOf(const TileKey& key);

/// Position steps of a level along the edge of a tile's core, half of those of its cube.
constexpr int kCoreBits = PRO_POSITION_BITS - 1;
constexpr std::int32_t kCoreSteps = 1 << kCoreBits;
/// From the cube's lowest corner to the core's.
constexpr std::int32_t kRimSteps = kCoreSteps / 2;

/// Whole position steps of a tile's level from the lowest corner of its core, each axis; the position is the middle of
/// its step. In the core they are 0 to kCoreSteps - 1, in the cube -kRimSteps to kCoreSteps + kRimSteps - 1.
using PositionCode = std::array<std::int32_t, 3>;

bool isInCore(const PositionCode& code);
bool isInCube(const PositionCode& code);

/// Of a position in input coordinates, seen from a tile; codes are held within a few thousand edges around it.
PositionCode codeOf(const TileSet& set, const TileKey& tile, const Vec3d& position);
/// Input coordinates.
Vec3d positionOf(const TileSet& set, const TileKey& tile, const PositionCode& code);

/// A code of one tile as one of another: of tiles of a level the same place to the bit; of other levels the step of
/// the second that holds the middle of the first one's step. Nothing where that is not in the second one's cube.
std::optional<PositionCode> codeIn(const TileKey& to, const TileKey& from, const PositionCode& code);

} // namespace pointrt

// SPDX-License-Identifier: GPL-3.0-or-later
// Positions in integer steps of a level's lattice, which all tiles of the level share.
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

/// Identifies a tile of a set.
struct TileKey {
    std::uint32_t level = 0;
    TileCell cell{};
    auto operator<=>(const TileKey&) const = default;
};

inline TileKey keyOf(const SetTile& tile) { return {tile.level, tile.cell}; }
inline TileKey parentOf(const TileKey& key) { return {key.level + 1, parentOf(key.cell)}; }
/// "L-X-Y-Z", used in file names.
std::string nameOf(const TileKey& key);

/// Position steps along the edge of a tile's core: half of those of its cube.
constexpr int kCoreBits = PRO_POSITION_BITS - 1;
constexpr std::int32_t kCoreSteps = 1 << kCoreBits;
/// From the cube's lowest corner to the core's.
constexpr std::int32_t kRimSteps = kCoreSteps / 2;

/// Integer position steps of a tile's level from the lowest corner of its core, per axis; the position is the middle of
/// its step. In the core they are 0 to kCoreSteps - 1, in the cube -kRimSteps to kCoreSteps + kRimSteps - 1.
using PositionCode = std::array<std::int32_t, 3>;

bool isInCore(const PositionCode& code);
bool isInCube(const PositionCode& code);

/// Code of a position in input coordinates, relative to a tile; clamped to a few thousand edges around it.
PositionCode codeOf(const TileSet& set, const TileKey& tile, const Vec3d& position);
/// Position of a code, input coordinates.
Vec3d positionOf(const TileSet& set, const TileKey& tile, const PositionCode& code);

/// Converts a code of a tile to a code of another tile. If they are on the same level, the position stays exactly the
/// same. Otherwise the result is the step of the other level that contains the middle of the given step. nullopt if it
/// is outside the other tile's cube.
std::optional<PositionCode> codeIn(const TileKey& to, const TileKey& from, const PositionCode& code);

} // namespace pointrt

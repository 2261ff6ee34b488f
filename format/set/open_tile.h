// SPDX-License-Identifier: Apache-2.0
// Tiles' files, held against what set.json says of them.
#pragma once

#include <cstdint>
#include <string>

#include "format/set/tile_set.h"
#include "pointrt/pro.hpp"

namespace pointrt {

/// "NAME.proset/tiles/0-1-2-3.pro".
std::string tilePath(const std::string& folder, const SetTile& tile);

/// Fills in stored, bytes and checksum of a file that has just been written. Reads its header only.
/// Throws Error{kBadInput, "FILE: reason"} for what is no .pro file.
void describeTile(const std::string& folder, SetTile& tile);

/// Whether the file is there and is the one that set.json names: its size, checksum, splats, cube and radii. Reads its
/// header only, so that a set of a thousand tiles takes milliseconds.
/// Throws Error{kBadInput, "FILE: is not the tile that set.json names (why)"} or "FILE: reason" where it cannot be
/// read.
void requireTile(const TileSet& set, const SetTile& tile, const std::string& folder);

/// The same, and a box around all discs of the file, those repeated from neighbours too, in input coordinates: around
/// their centres, with the largest radius that the header allows.
TileBox discBoundsOf(const TileSet& set, const SetTile& tile, const std::string& folder);

/// As requireTile, and opens it; flags and attributes are held against the set as well.
/// @param open_flags PRO_OPEN_*. Throws Error, its code as that of the format's library
ProFile openTile(const TileSet& set, const SetTile& tile, const std::string& folder, std::uint32_t open_flags);

} // namespace pointrt

// SPDX-License-Identifier: Apache-2.0
// Opens the files of tiles and checks them against set.json.
#pragma once

#include <cstdint>
#include <string>

#include "format/set/tile_set.h"
#include "pointrt/pro.hpp"

namespace pointrt {

/// "NAME.proset/tiles/0-1-2-3.pro".
std::string tilePath(const std::string& folder, const SetTile& tile);

/// Sets stored, bytes and checksum from the header of a file. Throws Error{kBadInput, "FILE: reason"} if it is not a
/// .pro file.
void describeTile(const std::string& folder, SetTile& tile);

/// Checks that the file exists and matches set.json: size, checksum, splats, cube and radii. Reads only the header, so
/// a thousand tiles take milliseconds. Throws Error{kBadInput, "FILE: is not the tile that set.json names (why)"}, or
/// "FILE: reason" if it cannot be read.
void requireTile(const TileSet& set, const SetTile& tile, const std::string& folder);

/// Like requireTile, but returns a box around all discs of the file, including copies from neighbours, in input
/// coordinates: the bounds of centres, enlarged by the largest radius.
TileBox discBoundsOf(const TileSet& set, const SetTile& tile, const std::string& folder);

/// Opens the file after requireTile, and checks flags and attributes, too. Throws Error.
/// @param open_flags PRO_OPEN_*
ProFile openTile(const TileSet& set, const SetTile& tile, const std::string& folder, std::uint32_t open_flags);

} // namespace pointrt

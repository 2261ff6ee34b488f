// SPDX-License-Identifier: Apache-2.0
// Splats in the core of a tile. A sample of them can be read without opening the file, for estimates over a whole set.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "format/set/tile_set.h"
#include "pointrt/pro.h"

namespace pointrt {

/// A splat as stored in a file.
using SplatWords = std::array<std::uint32_t, PRO_SPLAT_WORDS>;

/// Whether the centre lies in the core of the splat's tile: the half-open middle half of its cube on each axis.
bool isInCore(const pro_splat& splat);

/// Reads splats first, first + step, ... of a tile's file and returns those with centres in its core, in cube units of
/// cubeOf(set, tile). Reads only them and the header, without verifying sections; a damaged section yields other,
/// finite splats. Balls have the normal 0. Throws Error as requireTile, and kBadInput "FILE: reason" if splats cannot
/// be read.
/// @param step at least 1
std::vector<pro_splat> coreSplats(const TileSet& set, const SetTile& tile, const std::string& folder,
                                  std::uint64_t first, std::uint64_t step);

} // namespace pointrt

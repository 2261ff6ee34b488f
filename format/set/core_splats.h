// SPDX-License-Identifier: Apache-2.0
// Splats of a tile's core; some of them, read without opening its file: for what is to be known of a whole set, about.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "format/set/tile_set.h"
#include "pointrt/pro.h"

namespace pointrt {

/// Whether the centre lies in the core of the tile whose file the splat is of: the middle half of its cube, half open.
bool isInCore(const pro_splat& splat);

/// Of the splats number first, first + step, ... of a tile's file those whose centres lie in its core, in cube units of
/// cubeOf(set, tile). Besides them only the header is read: no section is checked, and what is wrong in one gives other
/// splats, all of them finite. Throws Error as requireTile, and kBadInput "FILE: reason" for one without splats.
/// @param step at least 1
std::vector<pro_splat> coreSplats(const TileSet& set, const SetTile& tile, const std::string& folder,
                                  std::uint64_t first, std::uint64_t step);

} // namespace pointrt

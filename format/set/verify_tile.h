// SPDX-License-Identifier: Apache-2.0
// Every check of a tile that there is: what its file is, and whether it agrees with its neighbours.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "format/set/tile_set.h"

namespace pointrt {

/// number: of SPEC.md, what pro_verify finds; 0 for what is of sets. text: without the file's name.
struct TileFinding {
    std::uint32_t number = 0;
    std::string text;
};

/// That the file is the one that set.json names, that pro_verify finds nothing, that its core holds as many splats as
/// set.json says, that repeats from tiles of its level (of an original tile: from original ones) are their owners'
/// splats to the bit, and that no splat of a neighbour of its level, merged as it is or not, is missing whose disc
/// surely crosses the core, and that nothing leaves the set's bounds and ranges of attributes. Neighbours that cannot
/// be opened have findings of their own. Reads the file and those of up to 26 neighbours. From several threads. @param
/// number below set.tiles.size()
std::vector<TileFinding> verifyTile(const TileSet& set, const std::string& folder, std::size_t number);

} // namespace pointrt

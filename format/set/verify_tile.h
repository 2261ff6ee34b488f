// SPDX-License-Identifier: Apache-2.0
// All checks of a tile: of its file, and against its neighbours.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "format/set/tile_set.h"

namespace pointrt {

/// number: of pro_verify, as in SPEC.md, or 0 for checks of sets. text: without the file's name.
struct TileFinding {
    std::uint32_t number = 0;
    std::string text;
};

/// Checks that
/// - the file is the one that set.json names, and pro_verify has no findings;
/// - its core holds as many splats as set.json states;
/// - copies from tiles of its level (for an original tile: from original ones) equal their owners' splats to the bit;
/// - no splat of a neighbour of its level and kind whose disc certainly crosses the core is missing;
/// - splats stay within the set's bounds and ranges of attributes.
/// Ignores neighbours that cannot be opened, which have findings of their own. Reads the file and up to 26 neighbours.
/// Thread-safe.
/// @param number index of the tile
std::vector<TileFinding> verifyTile(const TileSet& set, const std::string& folder, std::size_t number);

} // namespace pointrt

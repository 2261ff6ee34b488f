// SPDX-License-Identifier: Apache-2.0
// set.json of tile sets, and queries of a set that was read.
#include <cstdlib>

#include "format/set/tile_set.h"
#include "tests/fuzz/fuzz_target.h"

using namespace pointrt;

POINTRT_FUZZ_TARGET(tile_set) {
    fuzz::expectReadOrRefused("set.json", [&] {
        const TileSet set = parseTileSet(fuzz::textOf(input), "set.json");
        if (!findTileSetFault(set).empty()) std::abort(); // parsing must have refused it
        childrenOf(set);
        for (const SetTile& tile : set.tiles) {
            cubeOf(set, tile);
            if (!findTile(set, tile.level, tile.cell)) std::abort();
        }
    });
}

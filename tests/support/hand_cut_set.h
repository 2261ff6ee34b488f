// SPDX-License-Identifier: Apache-2.0
// Tile sets made by hand of a few splats: each tile has the splats of its core, and repeats those whose slabs come near
// it.
#pragma once

#include <string>

#include "format/set/tile_set.h"
#include "tests/support/splat_scenes.h"

namespace pointrt::test {

/// Two levels: the root, and below it the tiles that have splats.
struct HandCutSet {
    std::array<double, 3> lattice_origin{};
    double edge = 1;      ///< of the tiles' cores; the root's is twice that
    int cells = 2;        ///< tiles along each axis, 1 or 2
    double error = 1;     ///< of the root
    float radius_max = 0; ///< input units, at most a quarter of edge; all splats are coded by it
};

/// Writes NAME.proset of splats, whose radii are all radius_max, and the root with root_splats, which has another error
/// but may be the same splats. Returns what its set.json says.
TileSet writeHandCutSet(const std::string& folder, const HandCutSet& set, const Splats& splats,
                        const Splats& root_splats);

} // namespace pointrt::test

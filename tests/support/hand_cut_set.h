// SPDX-License-Identifier: Apache-2.0
// Small tile sets built directly from splats: each tile has the splats of its core and copies of those whose slabs come
// near it.
#pragma once

#include <string>

#include "format/set/tile_set.h"
#include "tests/support/splat_scenes.h"

namespace pointrt::test {

/// Two levels: the root, and the tiles with splats below it.
struct HandCutSet {
    std::array<double, 3> lattice_origin{};
    double edge = 1;      ///< of the tiles' cores; that of the root is twice as long
    int cells = 2;        ///< tiles along each axis, 1 or 2
    double error = 1;     ///< of the root
    float radius_max = 0; ///< input units, at most a quarter of edge; encodes all splats
};

/// Writes NAME.proset of splats, all of radius radius_max, with a root of root_splats, which may be the same splats
/// despite its larger error. Returns the contents of its set.json.
TileSet writeHandCutSet(const std::string& folder, const HandCutSet& set, const Splats& splats,
                        const Splats& root_splats);

} // namespace pointrt::test

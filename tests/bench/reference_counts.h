// SPDX-License-Identifier: Apache-2.0
// The number of references per splat in the same leaves, for different overlap tests.
#pragma once

#include <cstdint>

#include "pointrt/pro.hpp"

namespace pointrt::test {

/// Pairs of a splat and a leaf that a test lists, the pairs of a member and its own leaf included.
struct ListCount {
    std::uint64_t filled = 0; ///< in leaves that hold splats
    std::uint64_t empty = 0;  ///< in the other leaves of the full octree
};

struct ReferenceCounts {
    std::uint64_t splats = 0, filled_leaves = 0, empty_leaves = 0;
    ListCount disc_box;       ///< the disc's axis-aligned bounding box meets the leaf's cell
    ListCount slab_box;       ///< the blending slab's does
    ListCount disc;           ///< the disc itself does
    ListCount slab;           ///< the blending slab does: what a bake lists before it prunes
    std::uint64_t stored = 0; ///< members and references of the file
};

/// Cells are extended by half a position step on each side, as in the bake (preprocess/octree/build.cpp). Pruning drops
/// leaves, so use files baked with --prune off.
ReferenceCounts countReferences(const ProFile& file);

} // namespace pointrt::test

// SPDX-License-Identifier: Apache-2.0
// The number of references per splat in the same leaves, for different overlap tests.
#pragma once

#include <cstdint>

#include "pointrt/pro.hpp"

namespace pointrt::test {

/// Pairs of a splat and a leaf that a test lists, including those of a member and its own leaf.
struct ListCount {
    std::uint64_t filled = 0; ///< in leaves that hold splats
    std::uint64_t empty = 0;  ///< in the other leaves of the full octree, which are empty
};

struct ReferenceCounts {
    std::uint64_t splats = 0, filled_leaves = 0, empty_leaves = 0;
    ListCount disc_box;       ///< the disc's axis-aligned bounding box overlaps the leaf's cell
    ListCount slab_box;       ///< the bounding box of the blending slab does
    ListCount disc;           ///< the disc itself does
    ListCount slab;           ///< the blending slab itself does: what a bake lists before pruning
    std::uint64_t stored = 0; ///< members and references of the file
};

/// Cells are extended by half a position step on each side, as in the bake (preprocess/octree/build.cpp). Pruning drops
/// leaves, so use files baked with --prune off.
ReferenceCounts countReferences(const ProFile& file);

} // namespace pointrt::test

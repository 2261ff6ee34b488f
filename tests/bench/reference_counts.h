// SPDX-License-Identifier: Apache-2.0
// How many references a splat would cost in the same leaves, by the test that lists it there.
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

/// Cells count as half a position step larger on each side, as they do for the bake (preprocess/octree/build.cpp).
/// Pruning drops leaves: files baked with --prune off have all of them.
ReferenceCounts countReferences(const ProFile& file);

} // namespace pointrt::test

// SPDX-License-Identifier: GPL-3.0-or-later
// The full octree as a Morton-ordered list of its non-empty leaves, which defines it completely.
#pragma once

#include <cstdint>
#include <functional>
#include <vector>

#include "preprocess/octree/disc_box.h"
#include "preprocess/octree/quantize.h"

namespace pointrt {

/// A cube of the octree: depth halvings of the unit cube; code is the Morton code of its lowest corner.
struct Cell {
    std::uint64_t code = 0;
    std::uint32_t depth = 0;
};

/// Number of Morton codes in a cell.
inline std::uint64_t cellSpan(std::uint32_t depth) { return std::uint64_t{1} << (3 * (PRO_MAX_DEPTH - depth)); }
/// Edge length of a cell, cube units.
inline float cellEdge(std::uint32_t depth) { return std::ldexp(1.0f, -static_cast<int>(depth)); }
inline Cell childCell(const Cell& cell, std::uint32_t slot) {
    return {cell.code + slot * cellSpan(cell.depth + 1), cell.depth + 1};
}
Box cellBox(const Cell& cell);

/// A leaf that holds splats: members (centre inside) and references (tentative splats: centre elsewhere).
/// A leaf with references only is a border leaf: no centre lies in it, but a disc crosses it.
struct Leaf {
    Cell cell;
    std::uint32_t first_member = 0, member_count = 0; ///< range of the Morton-ordered splats
    std::uint32_t first_ref = 0, ref_count = 0;       ///< range of Octree::refs
};

struct Octree {
    std::vector<Leaf> leaves; ///< in Morton order
    std::vector<std::uint32_t> refs;
};

struct OctreeOptions {
    std::uint32_t max_leaf_splats = 8;       ///< members before a leaf splits that is wide enough to, at least 1
    std::uint32_t max_depth = PRO_MAX_DEPTH; ///< 0 to PRO_MAX_DEPTH
};

struct PruneOptions {
    std::uint32_t probe_rays = 64; ///< per leaf and round at least, more where that is too few for harm; at least 1
    double harm = 1e-4;            ///< share of random rays whose hit may change, with 95% confidence; in (0, 1)
    std::uint64_t seed = 0;
};

/// What the last round of probes found. A change is a hit, of the first disc or of the blended surface, that moves by
/// more than 1% of the disc's radius, or a normal or colour that differs visibly.
struct PruneReport {
    std::uint32_t rounds = 0;
    double cutoff = 0;        ///< splats that weigh less than this everywhere in a leaf were left out of it
    std::uint64_t probes = 0; ///< in the last round
    double harm = 0;          ///< share of them that saw a change, which was mended
    double harm_bound = 0;    ///< upper end of that share's 95% confidence interval
};

/// Called with the share done in [0, 1]; may come from any thread, one at a time.
using OctreeProgress = std::function<void(double)>;

/// Builds the leaves over splats and lists in each every splat whose blending slab meets it.
/// The result does not depend on the number of threads.
/// Throws Error (kBadUsage) when max_depth forces more than PRO_LEAF_LIST_MAX splats into one leaf.
Octree buildOctree(const PackedSplats& splats, const OctreeOptions& options, const OctreeProgress& progress = {});

/// Drops references that neither cross their leaf visibly nor weigh enough in it; see leaf_pruner.cpp. Rounds of
/// probes with ever lower weights follow one another until one keeps to options.harm, 6 at the most.
PruneReport pruneOctree(const PackedSplats& splats, const PruneOptions& options, Octree& octree,
                        const OctreeProgress& progress = {});

/// The leaves as NODE words, breadth first, groups of 8 (pro_layout.h). max_depth receives the deepest leaf's depth.
std::vector<std::uint32_t> encodeNodes(const std::vector<Leaf>& leaves, std::uint32_t& max_depth);

} // namespace pointrt

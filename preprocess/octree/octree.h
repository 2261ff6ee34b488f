// SPDX-License-Identifier: GPL-3.0-or-later
// The full octree, represented by its non-empty leaves in Morton order.
#pragma once

#include <cstdint>
#include <functional>
#include <vector>

#include "preprocess/octree/disc_box.h"
#include "preprocess/octree/quantize.h"

namespace pointrt {

/// A cell of the octree, with edge 2^-depth; code is the Morton code of its lowest corner.
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

/// A leaf with splats: members (centre inside) and references (tentative splats, centre outside). A leaf with
/// references only is a border leaf: a disc crosses it, but no centre lies in it.
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
    std::uint32_t max_leaf_splats = 8;       ///< at least 1; leaves with more members split if they are wide enough
    std::uint32_t max_depth = PRO_MAX_DEPTH; ///< 0 to PRO_MAX_DEPTH
};

struct PruneOptions {
    std::uint32_t probe_rays = 64; ///< minimum per leaf and round, at least 1; a small harm needs more
    double harm = 1e-4;            ///< fraction of random rays whose hit may change, with 95 % confidence; in (0, 1)
    std::uint64_t seed = 0;
};

/// Results of the last round of probes. A change is a hit (of the first disc or of the blended surface) that moves by
/// more than 1 % of the disc's radius, or a visibly different normal or colour.
struct PruneReport {
    std::uint32_t rounds = 0;
    double cutoff = 0;        ///< splats are dropped from a leaf if their weight is smaller than this everywhere in it
    std::uint64_t probes = 0; ///< in the last round
    double harm = 0;          ///< fraction of probes that saw a change (the missing splats were restored)
    double harm_bound = 0;    ///< upper end of the 95 % confidence interval of harm
};

/// Called with the fraction done, 0 to 1, from any thread, one call at a time.
using OctreeProgress = std::function<void(double)>;

/// Builds the leaves and lists in each one every splat whose blending slab overlaps it. The result does not depend on
/// the number of threads. Throws Error (kBadUsage) if max_depth forces more than PRO_LEAF_LIST_MAX splats into a leaf.
Octree buildOctree(const PackedSplats& splats, const OctreeOptions& options, const OctreeProgress& progress = {});

/// Drops references that neither cross their leaf visibly nor have enough weight in it (see leaf_pruner.cpp). Repeats
/// with lower cutoffs until a round of probes satisfies options.harm, at most 6 times.
PruneReport pruneOctree(const PackedSplats& splats, const PruneOptions& options, Octree& octree,
                        const OctreeProgress& progress = {});

/// The leaves as NODE words, breadth first in groups of 8 (pro_layout.h). max_depth receives the depth of the deepest
/// leaf.
std::vector<std::uint32_t> encodeNodes(const std::vector<Leaf>& leaves, std::uint32_t& max_depth);

} // namespace pointrt

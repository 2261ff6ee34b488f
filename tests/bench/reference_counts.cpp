// SPDX-License-Identifier: Apache-2.0
#include "tests/bench/reference_counts.h"

#include "preprocess/octree/disc_box.h"
#include "preprocess/octree/octree.h"

namespace pointrt::test {

namespace {

Disc discOf(const ProFile& file, std::size_t index) {
    const pro_splat splat = file.splat(index);
    return {Vec3f(splat.position), Vec3f(splat.normal), splat.radius};
}

Box slackBox(const Cell& cell) {
    constexpr float kSlack = 0.5f * PRO_POSITION_STEP;
    Box box = cellBox(cell);
    box.lo.array() -= kSlack;
    box.hi.array() += kSlack;
    return box;
}

bool boundsMeet(const Disc& disc, const Vec3f& reach, const Box& box) {
    return ((disc.center - reach).array() <= box.hi.array()).all() &&
           ((disc.center + reach).array() >= box.lo.array()).all();
}

/// Descends the octree with one splat after the other, into all cells that overlap the bounding box of its slab.
class Descent {
public:
    Descent(const ProFile& file, ReferenceCounts& counts)
        : nodes_(file.nodes()), slab_(file.info().blend_slab), counts_(counts) {}

    void run(const Disc& disc) {
        disc_ = disc;
        reach_ = discReach(disc);
        visit(nodes_[0], Cell{});
    }

private:
    void visit(std::uint32_t node, const Cell& cell) {
        const Box box = slackBox(cell), grown = growBySlab(box, disc_, slab_);
        if (!boundsMeet(disc_, reach_, grown)) return;
        if (!(node & PRO_NODE_INNER)) return count(box, grown, node == PRO_NODE_EMPTY);
        const std::size_t group = std::size_t{node & PRO_NODE_GROUP_MASK} * PRO_GROUP_SIZE;
        for (std::uint32_t slot = 0; slot < PRO_GROUP_SIZE; ++slot) visit(nodes_[group + slot], childCell(cell, slot));
    }

    void count(const Box& box, const Box& grown, bool empty) {
        const auto add = [&](ListCount& list, bool listed) { (empty ? list.empty : list.filled) += listed; };
        add(counts_.slab_box, true);
        add(counts_.disc_box, boundsMeet(disc_, reach_, box));
        add(counts_.slab, discOverlapsBox(disc_, grown));
        add(counts_.disc, discOverlapsBox(disc_, box));
    }

    std::span<const std::uint32_t> nodes_;
    float slab_;
    ReferenceCounts& counts_;
    Disc disc_{};
    Vec3f reach_ = Vec3f::Zero();
};

/// Each inner node replaces one leaf by eight.
std::uint64_t allLeaves(const pro_info& info) {
    const std::uint64_t inner = info.node_count / PRO_GROUP_SIZE - 1;
    return 1 + inner * (PRO_GROUP_SIZE - 1);
}

} // namespace

ReferenceCounts countReferences(const ProFile& file) {
    const pro_info& info = file.info();
    ReferenceCounts counts;
    counts.splats = info.splat_count;
    counts.filled_leaves = info.leaf_count;
    counts.empty_leaves = allLeaves(info) - info.leaf_count;
    counts.stored = std::uint64_t{info.splat_count} + info.ref_count;
    Descent descent(file, counts);
    for (std::size_t s = 0; s < info.splat_count; ++s) descent.run(discOf(file, s));
    return counts;
}

} // namespace pointrt::test

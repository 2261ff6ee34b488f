// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <filesystem>

#include "tests/bench/reference_counts.h"
#include "tests/support/splat_scenes.h"

namespace pointrt::test {

namespace {

struct Counted {
    Built built;
    ReferenceCounts counts;
};

Counted countScene(const Splats& splats, const BuildOptions& options) {
    const std::string path = temporaryPath("counts.pro");
    Built built = writeScene(path, splats, options);
    const ReferenceCounts counts = countReferences(ProFile(path));
    std::filesystem::remove(path);
    return {std::move(built), counts};
}

/// The number of pairs of a filled leaf and a disc whose bounding boxes overlap, found by testing all pairs.
std::uint64_t boxPairs(const Built& built) {
    std::uint64_t pairs = 0;
    for (const Leaf& leaf : built.octree.leaves) {
        const Box box = cellBox(leaf.cell);
        for (const Disc& disc : built.packed.discs) {
            const Eigen::AlignedBox3f bounds(disc.center - discReach(disc), disc.center + discReach(disc));
            pairs += bounds.intersects(Eigen::AlignedBox3f(box.lo, box.hi));
        }
    }
    return pairs;
}

} // namespace

TEST(ReferenceCounts, SlabsMatchABake) {
    const auto [built, counts] = countScene(randomSplats(3000, 5, 0.01f, 0.05f), {});
    EXPECT_EQ(counts.stored, built.packed.discs.size() + built.octree.refs.size());
    // slabs that only touch the extension of a cell may be listed or not: 7 pairs in 2 million for a scan
    EXPECT_NEAR(static_cast<double>(counts.slab.filled), static_cast<double>(counts.stored), 3);
    EXPECT_EQ(counts.filled_leaves, built.octree.leaves.size());
}

TEST(ReferenceCounts, BoxesMatchAllPairs) {
    const auto [built, counts] = countScene(randomSplats(1000, 6, 0.02f, 0.1f), {});
    // rounding decides on boxes that only touch
    EXPECT_NEAR(static_cast<double>(counts.disc_box.filled), static_cast<double>(boxPairs(built)), 3);
    EXPECT_GT(counts.disc_box.filled, counts.disc.filled);
    EXPECT_GT(counts.slab_box.filled, counts.slab.filled);
    EXPECT_EQ(counts.disc.empty, 0u) << "a disc overlaps an empty leaf";
}

TEST(ReferenceCounts, OneLeafListsEachSplatOnce) {
    BuildOptions options;
    options.octree.max_leaf_splats = 1000;
    const auto counts = countScene(sphereSplats(500, Vec3f::Zero(), 1.0f), options).counts;
    EXPECT_EQ(counts.filled_leaves, 1u);
    EXPECT_EQ(counts.empty_leaves, 0u);
    for (const ListCount& list : {counts.disc_box, counts.slab_box, counts.disc, counts.slab})
        EXPECT_EQ(list.filled, 500u);
}

} // namespace pointrt::test

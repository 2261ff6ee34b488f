// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include "tests/support/splat_scenes.h"

namespace pointrt::test {

namespace {

std::size_t references(const Built& built) { return built.packed.discs.size() + built.octree.refs.size(); }

TEST(Prune, DropsReferencesAndKeepsMembers) {
    BuildOptions options;
    const Built full = buildSplats(sphereSplats(20000, Vec3f(0, 0, 0), 1.0f), options);
    options.prune = true;
    const Built pruned = buildSplats(sphereSplats(20000, Vec3f(0, 0, 0), 1.0f), options);
    EXPECT_LT(references(pruned), 0.85 * static_cast<double>(references(full)));
    std::size_t members = 0;
    for (const Leaf& leaf : pruned.octree.leaves) members += leaf.member_count;
    EXPECT_EQ(members, pruned.packed.discs.size());
}

TEST(Prune, IsTheSameForTheSameSeed) {
    BuildOptions options;
    options.prune = true;
    const Built a = buildSplats(sphereSplats(3000, Vec3f(0, 0, 0), 1.0f), options);
    const Built b = buildSplats(sphereSplats(3000, Vec3f(0, 0, 0), 1.0f), options);
    EXPECT_EQ(a.octree.refs, b.octree.refs);
}

TEST(Prune, CoplanarSplatsNeedOnlyWhatCoversTheLeaf) {
    BuildOptions options;
    const auto plane = [] { return squareSplats(100, Vec3f(0, 0, 0), Vec3f(1, 0, 0), Vec3f(0, 1, 0), 1.5f); };
    const Built full = buildSplats(plane(), options);
    options.prune = true;
    const Built pruned = buildSplats(plane(), options);
    const double extra_full = static_cast<double>(full.octree.refs.size());
    const double extra_pruned = static_cast<double>(pruned.octree.refs.size());
    EXPECT_LT(extra_pruned, 0.35 * extra_full); // all say the same: only uncovered rims need a second splat
}

} // namespace

} // namespace pointrt::test

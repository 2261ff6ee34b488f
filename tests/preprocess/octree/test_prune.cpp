// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <algorithm>
#include <set>

#include "preprocess/octree/probe.h"
#include "tests/support/splat_scenes.h"

namespace pointrt::test {

namespace {

std::size_t references(const Built& built) { return built.packed.discs.size() + built.octree.refs.size(); }

Built build(Splats splats, bool prune, double harm = 1e-4) {
    BuildOptions options;
    options.prune = prune;
    options.probes.harm = harm;
    return buildSplats(std::move(splats), options);
}

Splats bumpySplats() {
    Splats splats = sphereSplats(20000, Vec3f(0, 0, 0), 1.0f);
    unsigned state = 1;
    for (std::size_t i = 0; i < splats.positions.size(); ++i) { // noise of a tenth of the radius, as in scans
        state = state * 1664525u + 1013904223u;
        splats.positions[i] *= 1.0f + 0.1f * splats.radii[i] * (static_cast<float>(state >> 8) / 0x1p23f - 1.0f);
    }
    return splats;
}

const Leaf* leafOf(const Octree& octree, std::uint64_t code) {
    for (const Leaf& leaf : octree.leaves)
        if (leaf.cell.code == code) return &leaf;
    return nullptr;
}

TEST(Prune, KeepsMembersAndCrossingDiscs) {
    const Built full = build(bumpySplats(), false), pruned = build(bumpySplats(), true, 0.05);
    EXPECT_LT(references(pruned), 0.95 * static_cast<double>(references(full)));
    std::size_t members = 0, crossing = 0;
    for (const Leaf& leaf : full.octree.leaves) {
        members += leaf.member_count;
        const Leaf* after = leafOf(pruned.octree, leaf.cell.code);
        std::set<std::uint32_t> kept;
        if (after)
            kept.insert(pruned.octree.refs.begin() + after->first_ref,
                        pruned.octree.refs.begin() + after->first_ref + after->ref_count);
        for (std::uint32_t r = leaf.first_ref; r < leaf.first_ref + leaf.ref_count; ++r) {
            Disc disc = full.packed.discs[full.octree.refs[r]];
            disc.radius *= 0.98f; // without slivers
            if (!discOverlapsBox(disc, cellBox(leaf.cell))) continue;
            ++crossing;
            EXPECT_TRUE(kept.contains(full.octree.refs[r]));
        }
    }
    EXPECT_EQ(members, pruned.packed.discs.size());
    EXPECT_GT(crossing, full.packed.discs.size() / 4);
}

TEST(Prune, IsDeterministicForASeed) {
    EXPECT_EQ(build(bumpySplats(), true).octree.refs, build(bumpySplats(), true).octree.refs);
}

TEST(Prune, StaysWithinTheHarmBound) {
    const Built lenient = build(bumpySplats(), true, 0.05), strict = build(bumpySplats(), true, 1e-4);
    EXPECT_LE(lenient.pruning.harm_bound, 0.05);
    EXPECT_LE(strict.pruning.harm_bound, 1e-4);
    EXPECT_LE(strict.pruning.harm, strict.pruning.harm_bound);
    EXPECT_GE(strict.pruning.probes, 3e4); // fewer could not prove it
    EXPECT_LT(references(lenient), references(strict));
}

TEST(Prune, FewLeavesGetMoreProbes) {
    const Built built = build(sphereSplats(200, Vec3f(0, 0, 0), 1.0f), true);
    EXPECT_GE(built.pruning.probes, 3e4);
    EXPECT_LE(built.pruning.harm_bound, 1e-4);
}

TEST(Probe, HeaviestPointHasTheLargestWeight) {
    const Box box{Vec3f(0, 0, 0), Vec3f(1, 1, 1)};
    for (const Vec3f& center : {Vec3f(1.2f, 0.5f, 0.5f), Vec3f(-0.1f, -0.1f, 0.4f), Vec3f(0.5f, 0.5f, 1.1f)}) {
        const Disc disc{center, Vec3f(0.3f, -0.4f, 0.866f).normalized(), 0.5f};
        float heaviest = 0;
        constexpr int kSteps = 60;
        for (int k = 0; k < kSteps * kSteps * kSteps; ++k) {
            const Vec3f grid(static_cast<float>(k % kSteps), static_cast<float>(k / kSteps % kSteps),
                             static_cast<float>(k / kSteps / kSteps));
            heaviest = std::max(heaviest, weightAt(disc, grid / (kSteps - 1.0f), 0.5f));
        }
        EXPECT_GT(heaviest, 0.01f);
        EXPECT_NEAR(weightAt(disc, heaviestPoint(disc, box, 0.5f), 0.5f), heaviest, 0.05f * heaviest);
    }
}

} // namespace

} // namespace pointrt::test

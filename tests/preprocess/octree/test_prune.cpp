// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <random>

#include "preprocess/octree/blend.h"
#include "tests/support/splat_scenes.h"

namespace pointrt::test {

namespace {

std::size_t references(const Built& built) { return built.packed.discs.size() + built.octree.refs.size(); }

DiscList wholeList(const Built& built) {
    DiscList list;
    list.discs = built.packed.discs;
    list.kept.assign(list.discs.size(), 1);
    return list;
}

TEST(Blend, SphereOfDiscsIsSmooth) {
    // flat discs of radius r on a sphere of radius R stand r^2 / 2R off at their rim; blending takes most of that away
    const Built built = buildSplats(sphereSplats(4000, Vec3f(0, 0, 0), 1.0f), {});
    const DiscList list = wholeList(built);
    const double scale = built.packed.frame.scale;
    double worst_height = 0, worst_angle = 0;
    std::mt19937 random(5);
    std::normal_distribution<float> gauss;
    for (int i = 0; i < 300; ++i) {
        const Vec3f outwards = Vec3f(gauss(random), gauss(random), gauss(random)).normalized();
        const Vec3f center = Vec3f::Constant(0.5f);
        const float sphere_radius = static_cast<float>(1.0 / scale);
        const Ray ray{center + 3.0f * sphere_radius * outwards, -outwards};
        SurfaceHit hit;
        ASSERT_TRUE(intersectBlended(list, ray, 0, 10, false, hit));
        worst_height = std::max(worst_height, std::abs(hit.t - 2.0 * sphere_radius) * scale);
        worst_angle = std::max(worst_angle, std::acos(std::min(1.0f, hit.normal.dot(outwards))) * 57.3);
    }
    const double spacing = std::sqrt(4 * 3.14159265 / 4000), radius = 1.2 * spacing;
    EXPECT_LT(worst_height, 0.5 * radius * radius / 2);
    EXPECT_LT(worst_angle, 0.25); // a disc's own normal is up to 57.3 * radius = 3.9 degrees off at its rim
}

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

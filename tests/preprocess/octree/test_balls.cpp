// SPDX-License-Identifier: Apache-2.0
// Balls in the octree and in files, against closed forms of spheres.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <set>

#include "pointrt/pro.hpp"
#include "preprocess/octree/blend.h"
#include "preprocess/octree/probe.h"
#include "tests/support/splat_scenes.h"

namespace pointrt::test {
namespace {

/// Every n-th splat is a ball.
Splats withBalls(Splats splats, std::size_t n) {
    for (std::size_t i = 0; i < splats.normals.size(); i += n) splats.normals[i].setZero();
    return splats;
}

double distanceToBox(const Vec3f& point, const Box& box) {
    double squared = 0;
    for (int axis = 0; axis < 3; ++axis) {
        const double below = double(box.lo[axis]) - double(point[axis]),
                     above = double(point[axis]) - double(box.hi[axis]);
        const double outside = std::max({below, above, 0.0});
        squared += outside * outside;
    }
    return std::sqrt(squared);
}

TEST(OctreeBalls, OverlapBoxesAsSpheresDo) {
    const Box box{Vec3f(0, 0, 0), Vec3f(1, 1, 1)};
    const Vec3f ball = Vec3f::Zero();
    EXPECT_TRUE(discOverlapsBox({Vec3f(0.5f, 0.5f, 0.5f), ball, 0.01f}, box));
    EXPECT_TRUE(discOverlapsBox({Vec3f(1.5f, 0.5f, 0.5f), ball, 0.51f}, box));
    EXPECT_FALSE(discOverlapsBox({Vec3f(1.5f, 0.5f, 0.5f), ball, 0.49f}, box));
    EXPECT_TRUE(discOverlapsBox({Vec3f(1.3f, 1.3f, 0.5f), ball, 0.43f}, box)); // the edge is at 0.424
    EXPECT_FALSE(discOverlapsBox({Vec3f(1.3f, 1.3f, 0.5f), ball, 0.42f}, box));
    EXPECT_TRUE(discOverlapsBox({Vec3f(1.1f, 1.1f, 1.1f), ball, 0.18f}, box)); // the corner is at 0.173
    EXPECT_FALSE(discOverlapsBox({Vec3f(1.1f, 1.1f, 1.1f), ball, 0.17f}, box));
}

TEST(OctreeBalls, AreListedWhereTheyMeetLeaves) {
    for (const std::size_t n : {1u, 2u}) {
        const Built built = buildSplats(withBalls(randomSplats(1500, 21, 0.005f, 0.06f), n), {});
        std::size_t references = 0;
        for (const Leaf& leaf : built.octree.leaves) {
            const Box box = cellBox(leaf.cell);
            std::set<std::uint32_t> listed;
            for (std::uint32_t m = 0; m < leaf.member_count; ++m) listed.insert(leaf.first_member + m);
            for (std::uint32_t r = 0; r < leaf.ref_count; ++r) listed.insert(built.octree.refs[leaf.first_ref + r]);
            for (std::uint32_t s = 0; s < built.packed.discs.size(); ++s) {
                const Disc& disc = built.packed.discs[s];
                const double distance = distanceToBox(disc.center, box) - double(disc.radius);
                if (!disc.isBall() || std::abs(distance) < 3e-6) continue; // within the slack of leaves
                EXPECT_EQ(listed.contains(s), distance < 0) << distance;
                references += distance < 0;
            }
        }
        EXPECT_GT(references, 1500 / n);
    }
}

TEST(OctreeBalls, AreNotPrunedWhereTheyAreSeen) {
    BuildOptions options;
    const Splats splats = withBalls(randomSplats(4000, 22, 0.01f, 0.04f), 2);
    const Built full = buildSplats(splats, options);
    options.prune = true;
    const Built pruned = buildSplats(splats, options);
    EXPECT_LT(pruned.octree.refs.size(), full.octree.refs.size());
    EXPECT_LE(pruned.pruning.harm_bound, options.probes.harm);
    std::size_t next = 0, crossing = 0;
    for (const Leaf& leaf : full.octree.leaves) {
        while (next < pruned.octree.leaves.size() && pruned.octree.leaves[next].cell.code < leaf.cell.code) ++next;
        std::set<std::uint32_t> kept;
        if (next < pruned.octree.leaves.size() && pruned.octree.leaves[next].cell.code == leaf.cell.code)
            for (std::uint32_t r = 0; r < pruned.octree.leaves[next].ref_count; ++r)
                kept.insert(pruned.octree.refs[pruned.octree.leaves[next].first_ref + r]);
        for (std::uint32_t r = 0; r < leaf.ref_count; ++r) {
            const std::uint32_t splat = full.octree.refs[leaf.first_ref + r];
            const Disc& disc = full.packed.discs[splat];
            const double reach = 0.98 * double(disc.radius); // without slivers at the rim
            if (!disc.isBall() || distanceToBox(disc.center, cellBox(leaf.cell)) > reach) continue;
            ++crossing;
            EXPECT_TRUE(kept.contains(splat));
        }
    }
    EXPECT_GT(crossing, 1000u);
}

TEST(OctreeBalls, AreHitByProbes) {
    std::mt19937 random(23);
    std::uniform_real_distribution<float> unit(0, 1);
    const PackedSplats packed = quantizeSplats(withBalls(randomSplats(50, 24, 0.05f, 0.2f), 2));
    DiscList list;
    for (const Disc& disc : packed.discs) list.add(disc, Vec3f::Zero(), true);
    list.pad();
    std::size_t hits = 0;
    for (int ray = 0; ray < 5000; ++ray) {
        const Vec3f origin(unit(random), unit(random), unit(random)),
            direction = sphereDirection(unit(random), unit(random));
        castRay(list, origin, direction, 2);
        for (std::size_t i = 0; i < packed.discs.size(); ++i) {
            const Disc& ball = packed.discs[i];
            if (!ball.isBall()) continue;
            const Vec3d to = (ball.center - origin).cast<double>(), along = direction.cast<double>().normalized();
            const double middle = to.dot(along), radius = double(ball.radius);
            const double half_squared = radius * radius - to.squaredNorm() + middle * middle;
            if (std::abs(half_squared) < 1e-4 * radius * radius) continue; // the ray grazes it
            const double half = std::sqrt(std::max(half_squared, 0.0)), first = middle - half, last = middle + half;
            const double t = half_squared > 0 ? (first >= 0 ? first : last) : -1;
            if (std::min(std::abs(first), std::abs(t)) < 1e-4) continue; // the ray starts on it
            EXPECT_EQ(std::isfinite(list.distance[i]), t >= 0);
            if (t < 0) continue;
            EXPECT_NEAR(double(list.distance[i]), t, 1e-3 * radius);
            ++hits;
        }
        weighAt(list, origin, Vec3f::UnitX(), 1);
        for (std::size_t i = 0; i < packed.discs.size(); ++i)
            EXPECT_FALSE(packed.discs[i].isBall() && list.weight[i] > 0);
    }
    EXPECT_GT(hits, 500u);
}

TEST(OctreeBalls, AreStoredAsSuch) {
    const Splats splats = withBalls(randomSplats(300, 25, 0.01f, 0.05f), 3);
    const std::string path = temporaryPath("balls_and_discs.pro");
    const Built built = writeScene(path, splats, {});
    const ProFile file(path);
    EXPECT_EQ(file.info().version_minor, 5u);
    EXPECT_NE(file.info().flags & PRO_FLAG_BALLS, 0u);
    for (std::uint32_t i = 0; i < file.info().splat_count; ++i) {
        const bool ball = file.order()[i] % 3 == 0;
        EXPECT_EQ(file.isBall(i), ball);
        EXPECT_EQ(built.packed.discs[i].isBall(), ball);
        const pro_splat splat = file.splat(i);
        EXPECT_NEAR(Vec3f(splat.normal).norm(), 1, 1e-6); // any direction for balls
        EXPECT_EQ(Vec3f(splat.position), built.packed.discs[i].center);
    }
}

TEST(OctreeBalls, FilesWithoutAnyAreAsBefore) {
    const std::string path = temporaryPath("discs_alone.pro");
    writeScene(path, randomSplats(300, 26, 0.01f, 0.05f), {});
    const ProFile file(path);
    EXPECT_EQ(file.info().version_minor, 0u);
    EXPECT_EQ(file.info().flags & PRO_FLAG_BALLS, 0u);
    for (std::uint32_t i = 0; i < file.info().splat_count; ++i) EXPECT_FALSE(file.isBall(i));
}

} // namespace
} // namespace pointrt::test

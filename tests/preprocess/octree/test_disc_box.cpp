// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <algorithm>
#include <random>

#include "preprocess/octree/disc_box.h"

namespace pointrt {

namespace {

/// Smallest distance from the box to a dense polar grid on the disc: at most one step above the true distance.
float sampledDistance(const Disc& disc, const Box& box) {
    const Vec3f helper = std::abs(disc.normal.x()) < 0.5f ? Vec3f::UnitX() : Vec3f::UnitY();
    const Vec3f a = disc.normal.cross(helper).normalized(), b = disc.normal.cross(a);
    float least = std::numeric_limits<float>::infinity();
    for (int ring = 0; ring <= 60; ++ring)
        for (int turn = 0; turn < 180; ++turn) {
            const float r = disc.radius * static_cast<float>(ring) / 60.0f,
                        angle = 0.0349066f * static_cast<float>(turn);
            const Vec3f p = disc.center + r * (std::cos(angle) * a + std::sin(angle) * b);
            const Vec3f outside = (box.lo - p).cwiseMax(p - box.hi).cwiseMax(0.0f);
            least = std::min(least, outside.norm());
        }
    return least;
}

TEST(DiscBox, AgreesWithDenseSampling) {
    std::mt19937 random(7);
    std::uniform_real_distribution<float> unit(-1.0f, 1.0f);
    std::normal_distribution<float> gauss;
    int overlapping = 0, missed = 0;
    for (int i = 0; i < 4000; ++i) {
        Box box{Vec3f(unit(random), unit(random), unit(random)), Vec3f::Zero()};
        box.hi = box.lo + Vec3f(unit(random), unit(random), unit(random)).cwiseAbs();
        Disc disc{1.5f * Vec3f(unit(random), unit(random), unit(random)),
                  Vec3f(gauss(random), gauss(random), gauss(random)).normalized(), 0.05f + std::abs(unit(random))};
        if (i % 5 == 0) disc.normal = Vec3f::Unit(i % 3); // degenerate directions
        const float distance = sampledDistance(disc, box);
        const float step = disc.radius * 0.04f; // spacing of the samples
        if (distance == 0.0f) {
            EXPECT_TRUE(discOverlapsBox(disc, box)) << i;
            ++overlapping;
        } else if (distance > step) {
            EXPECT_FALSE(discOverlapsBox(disc, box)) << i;
            ++missed;
        }
    }
    EXPECT_GT(overlapping, 150);
    EXPECT_GT(missed, 800);
}

TEST(DiscBox, KnownCases) {
    const Box box{Vec3f(0, 0, 0), Vec3f(1, 1, 1)};
    const Vec3f z = Vec3f::UnitZ(), diagonal = Vec3f(1, 1, 1).normalized();
    EXPECT_TRUE(discOverlapsBox({Vec3f(0.5f, 0.5f, 0.5f), z, 0.01f}, box));  // inside
    EXPECT_TRUE(discOverlapsBox({Vec3f(1.5f, 0.5f, 0.5f), z, 0.51f}, box));  // rim reaches the face
    EXPECT_FALSE(discOverlapsBox({Vec3f(1.5f, 0.5f, 0.5f), z, 0.49f}, box)); // rim does not reach the face
    EXPECT_FALSE(discOverlapsBox({Vec3f(0.5f, 0.5f, 1.1f), z, 0.5f}, box));  // floats above
    EXPECT_FALSE(discOverlapsBox({Vec3f(1.3f, 1.3f, 0.5f), z, 0.42f},
                                 box)); // its bounding box overlaps, the disc does not: the edge is at 0.424
    EXPECT_TRUE(discOverlapsBox({Vec3f(1.3f, 1.3f, 0.5f), z, 0.43f}, box));
    EXPECT_FALSE(discOverlapsBox({Vec3f(1.2f, 1.2f, 1.2f), diagonal, 0.9f}, box)); // its plane misses the corner
    EXPECT_TRUE(
        discOverlapsBox({Vec3f(0.99f, 0.99f, 0.99f) + 0.4f * Vec3f(1, -1, 0), diagonal, 0.6f}, box)); // cuts the corner
}

} // namespace

} // namespace pointrt

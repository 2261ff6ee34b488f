// SPDX-License-Identifier: Apache-2.0
// Overlap of discs and cubes against polygons clipped in double.
#include "format/index/disc_section.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "tests/format/index/disc_polygon.h"
#include "tests/format/index/random_vectors.h"
#include "tests/support/index_values.h"

namespace pointrt {
namespace {

using namespace test;

constexpr double kHalf = 0.5;
/// A cube around the origin.
const Cube kCube{{-kHalf, -kHalf, -kHalf}, 2 * kHalf};

/// Limits as in format/index/disc_section.cpp, whose tests are exact for components and radii within them.
constexpr double kMinComponent = 1.0 / 64, kLargestRadius = 16;

PlacedDisc placed(const PlainDisc& disc) {
    return {toVector(disc.center), toVector(disc.normal), static_cast<float>(disc.radius)};
}

/// Rounded to float, so that both sides test the same disc.
PlainDisc discOf(Vec3 center, Vec3 normal, double radius) {
    const Vector c = toVector(center), n = toVector(normalize(normal));
    PlainDisc disc{toVec3(c), normalize(toVec3(n)), {}, {}, static_cast<float>(radius)};
    disc.u = normalize(cross(disc.normal, std::abs(disc.normal.x) < 0.6 ? Vec3{1, 0, 0} : Vec3{0, 1, 0}));
    disc.v = cross(disc.normal, disc.u);
    return disc;
}

class DiscSectionRandomDiscs : public RandomVectors {
public:
    using RandomVectors::RandomVectors;

    /// A disc whose plane intersects the cube, and whose rim does so about half of the time.
    PlainDisc next() {
        const Vec3 normal = direction(), inside = point();
        const double radius = std::pow(10.0, uniform(-1.5, 1)), away = radius * uniform(0, 1.2) + uniform(0, 0.5);
        return discOf(inside + normalize(cross(normal, direction())) * away, normal, radius);
    }
};

double leastComponent(Vec3 v) { return std::min({std::abs(v.x), std::abs(v.y), std::abs(v.z)}); }

TEST(DiscSection, OverlapsCubesAsPolygonsDo) {
    DiscSectionRandomDiscs random(1);
    int overlapping = 0, missed = 0;
    for (int round = 0; round < 50'000; ++round) {
        const PlainDisc disc = random.next();
        // the clipped square must contain the section of the cube
        PlainDisc wide = disc;
        wide.radius = 2 * disc.radius + 2;
        const double distance = distanceTo(section(wide, kCube), disc);
        const bool overlaps = overlapsCube(placed(disc), kHalf);
        const bool near = distance<disc.radius*(1 - 1e-3), far = distance> disc.radius * (1 + 1e-3);
        overlapping += near, missed += far;
        ASSERT_TRUE(overlaps || !near) << round;
        ASSERT_TRUE(!overlaps || !far || leastComponent(disc.normal) < kMinComponent) << round;
    }
    EXPECT_GT(overlapping, 5'000);
    EXPECT_GT(missed, 5'000);
}

TEST(DiscSection, BoundsTheReachOfDiscAndPolygon) {
    DiscSectionRandomDiscs random(2);
    int inside = 0;
    for (int round = 0; round < 50'000; ++round) {
        const PlainDisc disc = random.next();
        const Vec3 along = normalize(cross(disc.normal, random.direction()));
        PlainDisc wide = disc;
        wide.radius = 2 * disc.radius + 2;
        double reach = -INFINITY;
        for (Vec3 corner : section(wide, kCube)) reach = std::max(reach, dot(along, corner - disc.center));
        if (reach == -INFINITY) continue; // the plane only touches the cube
        const double expected = std::min(reach, disc.radius), found = reachInCube(placed(disc), toVector(along), kHalf);
        ASSERT_GE(found, expected - 1e-4) << round;
        if (leastComponent(disc.normal) < kMinComponent) continue;
        ASSERT_LE(found, expected + 1e-4) << round;
        inside += reach < disc.radius;
    }
    EXPECT_GT(inside, 5'000);
}

/// A disc whose plane cuts a triangle off a corner of the cube, 1/8 from the corner along each axis.
TEST(DiscSection, IsExactAtACornerOfTheCube) {
    const double cut = 0.125, third = (3 * kHalf - cut) / 3, side = cut * std::sqrt(2.0);
    const Vec3 normal = normalize({1, 1, 1}), middle{third, third, third}, along = normalize({1, -1, 0});
    // next to a corner of the triangle, 1 % away from the rim or inside it
    const Vec3 corner{kHalf, kHalf - cut, kHalf}, center = corner + along * 0.3;
    EXPECT_TRUE(overlapsCube(placed(discOf(center, normal, 0.303)), kHalf));
    EXPECT_FALSE(overlapsCube(placed(discOf(center, normal, 0.297)), kHalf));
    EXPECT_NEAR(reachInCube(placed(discOf(middle, normal, 5)), toVector(along), kHalf), side / 2, 1e-5);
    EXPECT_NEAR(reachInCube(placed(discOf(middle, normal, 0.05)), toVector(along), kHalf), 0.05, 1e-6);
}

/// Rounding must not exclude an overlap.
TEST(DiscSection, TreatsHugeDiscsAsPlanes) {
    const PlainDisc huge = discOf({0, 0, 2 * kLargestRadius}, {1, 1, 0.01}, 2 * kLargestRadius - 1);
    EXPECT_TRUE(overlapsCube(placed(huge), kHalf));
    EXPECT_EQ(reachInCube(placed(huge), toVector(normalize({1, -1, 0})), kHalf), placed(huge).radius);
}

} // namespace
} // namespace pointrt

// SPDX-License-Identifier: Apache-2.0
// Points found by direction.
#include <gtest/gtest.h>

#include <set>

#include "preprocess/surface/sightline_map.h"
#include "tests/preprocess/surface/shapes.h"

namespace pointrt::test {
namespace {

using surface::SightlineMap;

Vec3f randomVector(Random& random) {
    return 2 * Vec3f(float(uniform(random)), float(uniform(random)), float(uniform(random))) - Vec3f::Ones();
}

/// Whether the ray from the origin through seen hits the box, in front of or behind seen.
bool passes(const Vec3f& seen, const Eigen::AlignedBox3f& box) {
    double from = 0, to = std::numeric_limits<double>::infinity();
    for (int axis = 0; axis < 3; ++axis) {
        const double a = double(box.min()[axis]) / double(seen[axis]), b = double(box.max()[axis]) / double(seen[axis]);
        from = std::max(from, std::min(a, b));
        to = std::min(to, std::max(a, b));
    }
    return from <= to;
}

TEST(SightlineMap, FindsAllSightlinesThroughABoxAndFewOthers) {
    Random random(3);
    std::vector<Vec3f> seen;
    for (int i = 0; i < 20'000; ++i) seen.push_back(randomVector(random));
    seen.push_back(Vec3f::Zero());
    const SightlineMap map(seen);
    for (int i = 0; i < 300; ++i) {
        const Vec3f center = randomVector(random);
        const float half = 0.02f + 0.05f * float(uniform(random));
        const Eigen::AlignedBox3f box(center - Vec3f::Constant(half), center + Vec3f::Constant(half));
        if (center.cwiseAbs().maxCoeff() < 3 * half) continue;
        std::size_t found = 0, through = 0;
        map.forSightlines(box, [&](const Vec3f& each) {
            ++found;
            through += passes(each, box);
        });
        std::size_t expected = 0;
        for (const Vec3f& each : seen) expected += !each.isZero() && passes(each, box);
        EXPECT_EQ(through, expected) << center.transpose();
        // allows for the box's extent in depth and one more cell on each side
        EXPECT_LE(found, 8 * expected + 60) << center.transpose();
    }
}

TEST(SightlineMap, DirectionsAlongALineTakeNoMoreCellsThanPoints) {
    std::vector<Vec3f> line;
    for (int i = 0; i < 1000; ++i) line.emplace_back(1.0f, 0.002f * float(i) - 1, 0.0f);
    for (const std::vector<Vec3f>& seen : {line, std::vector<Vec3f>(1, Vec3f(1, 0, 0)), std::vector<Vec3f>()}) {
        const SightlineMap map(seen);
        std::size_t found = 0;
        map.forSightlines({Vec3f(0.5f, -0.7f, -0.1f), Vec3f(0.6f, 0.7f, 0.1f)}, [&](const Vec3f&) { ++found; });
        EXPECT_EQ(found, seen.size());
    }
}

} // namespace
} // namespace pointrt::test

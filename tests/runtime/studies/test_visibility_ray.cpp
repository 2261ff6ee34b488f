// SPDX-License-Identifier: Apache-2.0
// Offsets and self-intersection distances of visibility rays.
#include "runtime/studies/visibility_ray.h"

#include <gtest/gtest.h>

#include <numbers>

namespace pointrt {
namespace {

const StudyDisc kLevel{{1, 2, 3}, {0, 0, 1}, 0.4, 0, true};

TEST(VisibilityRay, StartsAQuarterOfTheRadiusAboveTheDisc) {
    EXPECT_EQ(rayToLight(kLevel, {0, 0, 1}).start, (Vec3{1, 2, 3.1}));
    EXPECT_EQ(rayToLight(kLevel, {0, 0, -1}).start, (Vec3{1, 2, 2.9}));
    EXPECT_EQ(rayToLight(kLevel, {0, 0, -1}).normal, (Vec3{0, 0, -1}));
    EXPECT_TRUE(isFacing(kLevel, {1, 0, 0.1}));
    EXPECT_FALSE(isFacing(kLevel, {1, 0, -0.1}));
    StudyDisc both = kLevel;
    both.one_sided = false;
    EXPECT_TRUE(isFacing(both, {1, 0, -0.1}));
}

TEST(VisibilityRay, SelfIntersectionsEndThreeRadiiUpAtTwoDegreesAndMore) {
    EXPECT_NEAR(rayToLight(kLevel, {0, 0, 1}).self_distance, 1.2, 1e-12);
    EXPECT_NEAR(rayToLight(kLevel, normalize({1, 0, 1})).self_distance, 1.2 * std::sqrt(2.0), 1e-12);
    const double two_degrees = std::sin(2 * std::numbers::pi / 180);
    EXPECT_NEAR(rayToLight(kLevel, normalize({1, 0, 0.05})).self_distance, 1.2 * std::hypot(1, 0.05) / 0.05, 1e-9);
    EXPECT_NEAR(rayToLight(kLevel, normalize({1, 0, 0.01})).self_distance, 1.2 / two_degrees, 1e-5);
    StudyDisc noisy = kLevel;
    noisy.noise = 0.3;
    EXPECT_NEAR(rayToLight(noisy, {0, 0, 1}).self_distance, 1.5, 1e-12);
    noisy.noise = 3; // limited to one radius
    EXPECT_NEAR(rayToLight(noisy, {0, 0, 1}).self_distance, 2, 1e-12);
    StudyDisc place = kLevel;
    place.radius = 0;
    EXPECT_EQ(rayToLight(place, {0, 0, 1}).self_distance, 0);
}

TEST(VisibilityRay, EndsAtTheObserver) {
    const VisibilityRay ray = rayToObserver(kLevel, {1, 2, 13.1});
    EXPECT_NEAR(ray.length, 10, 1e-12);
    EXPECT_NEAR(ray.self_distance, 1.2, 1e-12);
    EXPECT_NEAR(rayToObserver(kLevel, {1, 2, 3.6}).self_distance, 0.5, 1e-12); // not beyond the observer
    EXPECT_NEAR(rayToObserver(kLevel, {1, 2, 3.1}).length, 0.1, 1e-12);        // an observer at the lifted origin
}

TEST(VisibilityRay, SelfIntersectionsAreParallelAndCrossedFromBelow) {
    const VisibilityRay ray = rayToLight(kLevel, normalize({1, 0, 1}));
    EXPECT_TRUE(isSelfIntersection(ray, {0, 0, -1}));
    EXPECT_FALSE(isSelfIntersection(ray, {0, 0, 1}));  // crossed from above
    EXPECT_FALSE(isSelfIntersection(ray, {-1, 0, 0})); // a wall
    EXPECT_TRUE(isSelfIntersection(ray, normalize({-1, 0, -1})));
    EXPECT_FALSE(isSelfIntersection(ray, normalize({-2, 0, -1}))); // 63 degrees
}

} // namespace
} // namespace pointrt

// SPDX-License-Identifier: Apache-2.0
// How rays leave discs.
#include "runtime/studies/departure.h"

#include <gtest/gtest.h>

#include <numbers>

namespace pointrt {
namespace {

const StudyDisc kLevel{{1, 2, 3}, {0, 0, 1}, 0.4, 0, true};

TEST(Departure, StartsAQuarterOfTheRadiusUpOnTheRaysSide) {
    EXPECT_EQ(leaveTowards(kLevel, {0, 0, 1}).start, (Vec3{1, 2, 3.1}));
    EXPECT_EQ(leaveTowards(kLevel, {0, 0, -1}).start, (Vec3{1, 2, 2.9}));
    EXPECT_EQ(leaveTowards(kLevel, {0, 0, -1}).normal, (Vec3{0, 0, -1}));
    EXPECT_TRUE(isFaced(kLevel, {1, 0, 0.1}));
    EXPECT_FALSE(isFaced(kLevel, {1, 0, -0.1}));
    StudyDisc both = kLevel;
    both.one_sided = false;
    EXPECT_TRUE(isFaced(both, {1, 0, -0.1}));
}

TEST(Departure, OwnsThreeRadiiUpDownToTwoDegrees) {
    EXPECT_NEAR(leaveTowards(kLevel, {0, 0, 1}).own_reach, 1.2, 1e-12);
    EXPECT_NEAR(leaveTowards(kLevel, normalize({1, 0, 1})).own_reach, 1.2 * std::sqrt(2.0), 1e-12);
    const double two_degrees = std::sin(2 * std::numbers::pi / 180);
    EXPECT_NEAR(leaveTowards(kLevel, normalize({1, 0, 0.05})).own_reach, 1.2 * std::hypot(1, 0.05) / 0.05, 1e-9);
    EXPECT_NEAR(leaveTowards(kLevel, normalize({1, 0, 0.01})).own_reach, 1.2 / two_degrees, 1e-5);
    StudyDisc noisy = kLevel;
    noisy.noise = 0.3;
    EXPECT_NEAR(leaveTowards(noisy, {0, 0, 1}).own_reach, 1.5, 1e-12);
    noisy.noise = 3; // counts as one radius
    EXPECT_NEAR(leaveTowards(noisy, {0, 0, 1}).own_reach, 2, 1e-12);
    StudyDisc place = kLevel;
    place.radius = 0;
    EXPECT_EQ(leaveTowards(place, {0, 0, 1}).own_reach, 0);
}

TEST(Departure, EndsAtTheEye) {
    const Departure ray = leaveFor(kLevel, {1, 2, 13.1});
    EXPECT_NEAR(ray.length, 10, 1e-12);
    EXPECT_NEAR(ray.own_reach, 1.2, 1e-12);
    EXPECT_NEAR(leaveFor(kLevel, {1, 2, 3.6}).own_reach, 0.5, 1e-12); // no farther
    EXPECT_NEAR(leaveFor(kLevel, {1, 2, 3.1}).length, 0.1, 1e-12);    // where the lifted start would be
}

TEST(Departure, OwnSurfaceIsParallelAndCrossedFromBelow) {
    const Departure ray = leaveTowards(kLevel, normalize({1, 0, 1}));
    EXPECT_TRUE(isOwnSurface(ray, {0, 0, -1}));
    EXPECT_FALSE(isOwnSurface(ray, {0, 0, 1}));  // comes back to it
    EXPECT_FALSE(isOwnSurface(ray, {-1, 0, 0})); // a wall
    EXPECT_TRUE(isOwnSurface(ray, normalize({-1, 0, -1})));
    EXPECT_FALSE(isOwnSurface(ray, normalize({-2, 0, -1}))); // 63 degrees
}

} // namespace
} // namespace pointrt

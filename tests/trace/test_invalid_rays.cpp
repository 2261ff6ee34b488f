// SPDX-License-Identifier: Apache-2.0
// Rays that are not finite hit nothing, end at once, and do not affect other rays. A division by zero in a shader
// produces such rays, and an endless traversal hangs a GPU.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <string>
#include <vector>

#include "tests/support/ray_caster.h"
#include "tests/support/splat_scenes.h"

namespace pointrt::test {
namespace {

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN(), kInfinity = std::numeric_limits<double>::infinity();

std::vector<Ray> invalidRays() {
    std::vector<Ray> rays;
    for (const double bad : {kNaN, kInfinity, -kInfinity})
        for (std::size_t axis = 0; axis < 3; ++axis) {
            Vec3 origin{0.5, 0.5, -0.5}, direction{0, 0, 1};
            (axis == 0 ? direction.x : axis == 1 ? direction.y : direction.z) = bad;
            rays.push_back({origin, direction});
            (axis == 0 ? origin.x : axis == 1 ? origin.y : origin.z) = bad;
            rays.push_back({origin, {0, 0, 1}});
        }
    return rays;
}

TEST(InvalidRays, MeetNothingAndSpareTheirNeighbours) {
    const std::string path = temporaryPath("invalid_rays.pro");
    writeScene(path, sphereSplats(3000, Vec3f(0, 0, 0), 1.0f), {});
    RayCaster caster(path);
    const std::vector<Ray> valid = caster.cameraRays(32), invalid = invalidRays();
    std::vector<Ray> mixed;
    for (std::size_t i = 0; i < valid.size(); ++i) {
        mixed.push_back(valid[i]);
        mixed.push_back(invalid[i % invalid.size()]);
    }
    const std::vector<CastHit> expected = caster.cast(valid), hits = caster.cast(mixed);
    std::size_t met = 0;
    for (std::size_t i = 0; i < valid.size(); ++i) {
        EXPECT_EQ(hits[2 * i].splat, expected[i].splat);
        EXPECT_FALSE(hits[2 * i + 1].hit()) << "invalid ray " << i % invalid.size();
        met += expected[i].hit() ? 1 : 0;
    }
    EXPECT_GT(met, valid.size() / 8);
}

} // namespace
} // namespace pointrt::test

// SPDX-License-Identifier: Apache-2.0
// The studio that surrounds scans by default.
#include "runtime/scene/default_lighting.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "runtime/scene/camera.h"

namespace pointrt {
namespace {

constexpr Vec3 kLow{-3, -2, -1.25}, kHigh{3, 2, 1.25};

SceneDescription studio(Vec3 eye, bool around_eye) {
    SceneDescription scene;
    scene.up = Vec3{0, 0, 1};
    Camera camera;
    camera.eye = eye;
    addSurroundings(scene, RenderSettings{}, camera, kLow, kHigh, {0.5, around_eye});
    return scene;
}

TEST(Studio, FlatDiscsAtTheBottomAreAboveTheFloor) {
    const SceneDescription scene = studio({0, -10, 0}, false);
    ASSERT_EQ(scene.shapes.size(), 1u);
    const double gap = kLow.z - scene.shapes[0].center.z;
    const double float_step = std::ldexp(10.0, -23); // of coordinates as large as the eye's
    EXPECT_GT(gap, 100 * float_step);
    EXPECT_LT(gap, 0.01) << "a centimetre";
}

TEST(Studio, HasNoFloorForAnEyeBelowIt) {
    const SceneDescription scene = studio({0, -1, -10}, false);
    EXPECT_TRUE(scene.shapes.empty());
    ASSERT_EQ(scene.lights.size(), 3u);
    for (const auto& light : scene.lights)
        EXPECT_LT(std::get<SunLight>(light).towards.z, 0) << "on the side of the eye";
}

double lampOn(const PointLight& lamp, Vec3 place) {
    const double away = length(lamp.position - place);
    return double{lamp.intensity[1]} / (away * away);
}

TEST(Studio, InRoomsTheLampIsBetweenEyeAndCeiling) {
    const Vec3 eye{0.5, -0.5, 0};
    const SceneDescription scene = studio(eye, true);
    ASSERT_EQ(scene.lights.size(), 1u);
    const PointLight& lamp = std::get<PointLight>(scene.lights[0]);
    EXPECT_LT(lamp.position.z, kHigh.z - 0.2);
    EXPECT_GT(lamp.position.z, eye.z + 0.4);
    const double beside = lampOn(lamp, eye + Vec3{0.4, 0, 0}), far = lampOn(lamp, {-3, 0, 0});
    EXPECT_LT(beside, 32 * far) << "five stops";
}

} // namespace
} // namespace pointrt

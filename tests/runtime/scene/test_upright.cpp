// SPDX-License-Identifier: Apache-2.0
// The up direction of scenes, and default cameras by it.
#include "runtime/scene/upright.h"

#include <gtest/gtest.h>

#include "format/base/error.h"
#include "runtime/scene/camera.h"
#include "runtime/scene/default_lighting.h"
#include "tests/support/says.h"

namespace pointrt {
namespace {

constexpr Vec3 kUprightX{1, 0, 0}, kYUp{0, 1, 0}, kZUp{0, 0, 1};

void expectUpNear(Vec3 a, Vec3 b) { EXPECT_LT(length(a - b), 1e-12) << a.x << " " << a.y << " " << a.z; }

/// A scene and its cameras after resolveUp has been applied.
struct Stood {
    SceneDescription scene;
    CameraRequest camera, staging;
    Camera framed() const { return frameCamera(camera, {-1, -2, -3}, {1, 2, 3}, 1); }
};

Stood stand(SceneDescription scene, CameraRequest camera, const UpRequest& request) {
    Stood stood{std::move(scene), camera, camera};
    resolveUp(stood.scene, stood.camera, stood.staging, request);
    return stood;
}

TEST(Upright, AxesHaveNames) {
    EXPECT_EQ(axisNamed("z"), kZUp);
    EXPECT_EQ(axisNamed("-x"), -1.0 * kUprightX);
    for (const char* word : {"auto", "Z", "", "0,0,1"}) EXPECT_FALSE(axisNamed(word)) << word;
    EXPECT_EQ(axisName({0, -1, 0}), "-y");
    EXPECT_EQ(axisName({0, 0.5, 0.5}), "");
}

TEST(Upright, ScansWithoutAnUpAreUnchanged) {
    for (const auto& fallback : {std::optional<Vec3>(), std::optional(kYUp)}) {
        const Stood stood = stand({}, {}, {{}, fallback});
        EXPECT_EQ(stood.scene.up, fallback);
        EXPECT_EQ(stood.camera, CameraRequest{});
        EXPECT_EQ(stood.framed(), frameCamera({}, {-1, -2, -3}, {1, 2, 3}, 1));
        EXPECT_EQ(sceneUp(stood.scene, {}), kYUp);
    }
}

TEST(Upright, ScansWithUpAlongZAreSeenFromTheirFront) {
    const Stood stood = stand({}, {}, {kZUp, {}});
    EXPECT_EQ(stood.scene.up, kZUp);
    EXPECT_EQ(stood.staging.up, kZUp);
    const Camera camera = stood.framed();
    expectUpNear(camera.forward, kYUp);
    expectUpNear(camera.up, kZUp);
    expectUpNear(camera.right, kUprightX);
}

TEST(Upright, ScansWithUpAlongYAreSeenAsByDefault) {
    const Stood stood = stand({}, {}, {kYUp, {}});
    EXPECT_EQ(stood.framed(), frameCamera({}, {-1, -2, -3}, {1, 2, 3}, 1));
}

TEST(Upright, GivenUpsTakePrecedence) {
    SceneDescription said;
    said.up = kUprightX;
    EXPECT_EQ(stand(said, {}, {kZUp, kYUp}).scene.up, kUprightX);
    CameraRequest camera;
    camera.up = Vec3{0, 0.1, 1};
    const Stood alone = stand({}, camera, {kYUp, {}}); // a .pro with --up X,Y,Z
    EXPECT_FALSE(alone.scene.up);
    EXPECT_EQ(alone.camera, camera);
    const Stood filed = stand({}, camera, {kUprightX, kYUp}); // a scene file, whose camera may be tilted
    EXPECT_EQ(filed.scene.up, kUprightX);
    EXPECT_EQ(filed.camera, camera);
}

TEST(Upright, ViewsWithoutAnUpUseTheScenes) {
    SceneDescription scene;
    scene.views = {{"plain", {}}, {"tilted", {}}};
    scene.views[1].camera.up = kUprightX;
    const Stood stood = stand(scene, {}, {kZUp, kYUp});
    EXPECT_EQ(stood.scene.views[0].camera.up, kZUp);
    expectUpNear(stood.scene.views[0].camera.side, {0, -1, 0});
    EXPECT_EQ(stood.scene.views[1].camera, scene.views[1].camera);
}

TEST(Upright, TheSunFollows) {
    SceneDescription scene;
    scene.lights = {PointLight{}, SunLight{}};
    scene.suns = {{1, {30, 90}, {}, "scene.toml:3: "}}; // in the east
    const Stood by_z = stand(scene, {}, {kZUp, kYUp});
    const double half_root = std::sqrt(0.75);
    expectUpNear(std::get<SunLight>(by_z.scene.lights[1]).towards, {half_root, 0, 0.5});
    EXPECT_TRUE(by_z.scene.suns.empty());
    expectUpNear(std::get<SunLight>(stand(scene, {}, {{}, kYUp}).scene.lights[1]).towards, {half_root, 0.5, 0});
    scene.suns[0].north = kUprightX;
    expectUpNear(std::get<SunLight>(stand(scene, {}, {kZUp, kYUp}).scene.lights[1]).towards, {0, -half_root, 0.5});
    scene.suns[0].north = kZUp;
    try {
        stand(scene, {}, {kZUp, kYUp});
        FAIL();
    } catch (const Error& error) {
        EXPECT_SAYS(error.what(), "scene.toml:3: *along*\"up\"");
    }
}

TEST(Upright, FrontsAreLevel) {
    expectUpNear(frontSide(kYUp), kZUp);
    expectUpNear(frontSide(2 * kUprightX), kZUp);
    expectUpNear(frontSide(-3.0 * kZUp), {0, -1, 0});
    expectUpNear(frontSide({0, -2, 0}), -1.0 * kZUp); // a camera's frame: y points down, and the camera looks along z
    for (const Vec3 up : {Vec3{1, 2, 3}, Vec3{0, 1e-9, 1e-9}, Vec3{0, 1, 1e300}, Vec3{0.6, 0.64, 0.48}}) {
        const Vec3 front = frontSide(up);
        EXPECT_NEAR(length(front), 1, 1e-12);
        EXPECT_NEAR(dot(front, up * (1 / std::max({std::abs(up.x), std::abs(up.y), std::abs(up.z)}))), 0, 1e-12);
    }
}

} // namespace
} // namespace pointrt

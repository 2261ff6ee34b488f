// SPDX-License-Identifier: Apache-2.0
#include "runtime/settings.h"

#include <gtest/gtest.h>

namespace pointrt {
namespace {

SceneDescription talkativeScene() {
    SceneDescription scene;
    scene.camera.eye = Vec3{1, 2, 3};
    scene.camera.target = Vec3{4, 5, 6};
    scene.camera.fov_deg = 25;
    scene.integrator = Integrator::kPath;
    scene.bounces = 9;
    scene.spp = 64;
    scene.width = 800;
    scene.height = 600;
    return scene;
}

TEST(Settings, AreTheSceneFilesWhereTheCommandLineIsSilent) {
    const RenderSettings settings = resolveSettings({}, talkativeScene());
    EXPECT_EQ(settings.camera.eye->y, 2);
    EXPECT_EQ(settings.camera.target->y, 5);
    EXPECT_EQ(settings.camera.fov_deg, 25);
    EXPECT_EQ(settings.integrator, Integrator::kPath);
    EXPECT_EQ(settings.bounces, 9u);
    EXPECT_EQ(settings.spp, 64u);
    EXPECT_EQ(settings.width, 800u);
    EXPECT_EQ(settings.height, 600u);
}

TEST(Settings, AreTheCommandLinesWhereItSpeaks) {
    Options options;
    options.choices = {Integrator::kDepth, 1u, 2u, 30u, 20u, 60.0};
    options.render.camera.eye = Vec3{7, 7, 7};
    const RenderSettings settings = resolveSettings(options, talkativeScene());
    EXPECT_EQ(settings.camera.eye->y, 7);
    EXPECT_EQ(settings.camera.target->y, 5) << "the file's, as nothing else was said";
    EXPECT_EQ(settings.camera.fov_deg, 60);
    EXPECT_EQ(settings.integrator, Integrator::kDepth);
    EXPECT_EQ(settings.bounces, 1u);
    EXPECT_EQ(settings.spp, 2u);
    EXPECT_EQ(settings.width, 30u);
    EXPECT_EQ(settings.height, 20u);
}

TEST(Settings, AreDefaultsWhereNothingIsSaid) {
    const RenderSettings settings = resolveSettings({}, {}), defaults;
    EXPECT_EQ(settings.integrator, Integrator::kPhong);
    EXPECT_EQ(settings.spp, defaults.spp);
    EXPECT_EQ(settings.width, defaults.width);
    EXPECT_EQ(settings.camera.fov_deg, 40);
    EXPECT_FALSE(settings.camera.eye || settings.camera.target || settings.camera.up);
}

TEST(Settings, LeaveSamplesToLimitsUnlessTheCommandLineCountsThem) {
    Options options;
    options.limits.noise = 0.1;
    EXPECT_EQ(resolveSettings(options, talkativeScene()).spp, kMaxSpp);
    options.choices.spp = 7;
    EXPECT_EQ(resolveSettings(options, talkativeScene()).spp, 7u);
}

TEST(Settings, DenoiseWhatIsNoisy) {
    Options options;
    options.output = "a.png";
    RenderSettings settings;
    SceneDescription scene;
    scene.lights = {PointLight{}};
    EXPECT_FALSE(wantsDenoising(options, settings, scene, 4)) << "hard shadows";
    settings.integrator = Integrator::kPath;
    EXPECT_TRUE(wantsDenoising(options, settings, scene, 4));
    EXPECT_FALSE(wantsDenoising(options, settings, scene, 256));
    settings.integrator = Integrator::kWhitted;
    scene.lights = {SunLight{}};
    EXPECT_TRUE(wantsDenoising(options, settings, scene, 255));
    scene.lights = {SunLight{{0, 1, 0}, 0, {}}};
    EXPECT_FALSE(wantsDenoising(options, settings, scene, 4));
    scene.lights = {QuadLight{}};
    EXPECT_TRUE(wantsDenoising(options, settings, scene, 4));
    settings.integrator = Integrator::kNormal;
    EXPECT_FALSE(wantsDenoising(options, settings, scene, 4));
}

TEST(Settings, KeepDataAsTheyAreUnlessAsked) {
    Options options;
    options.output = "a.exr";
    RenderSettings settings;
    settings.integrator = Integrator::kPath;
    EXPECT_FALSE(wantsDenoising(options, settings, {}, 4));
    options.denoise = DenoiseChoice::kOn;
    EXPECT_TRUE(wantsDenoising(options, settings, {}, 1000));
    options.output = "a.png";
    options.denoise = DenoiseChoice::kOff;
    EXPECT_FALSE(wantsDenoising(options, settings, {}, 4));
}

} // namespace
} // namespace pointrt

// SPDX-License-Identifier: Apache-2.0
#include "runtime/session/settings.h"

#include <gtest/gtest.h>

#include "format/base/error.h"
#include "tests/support/says.h"

namespace pointrt {
namespace {

SceneDescription talkativeScene() {
    SceneDescription scene;
    scene.camera.eye = Vec3{1, 2, 3};
    scene.camera.target = Vec3{4, 5, 6};
    scene.camera.fov_deg = 25;
    RenderChoices& said = scene.render;
    said.integrator = Integrator::kPath;
    said.bounces = 9;
    said.spp = 64;
    said.size = PixelSize{800, 600};
    said.seed = 5;
    said.shadows = said.caustics = said.blend = false;
    said.denoise = DenoiseChoice::kOn;
    said.exposure = 1.5f;
    said.room = Room::kMatte;
    said.lights = 2;
    said.background = Background{{9, 8, 7}, false};
    said.reflectivity = 0.5f;
    return scene;
}

TEST(Settings, ComeFromTheSceneFileUnlessGiven) {
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

TEST(Settings, ColourSettingsComeFromTheSceneFileToo) {
    RenderSettings settings = resolveSettings({}, talkativeScene());
    EXPECT_EQ(settings.seed, 5u);
    EXPECT_FALSE(settings.shadows || settings.caustics || settings.blend);
    EXPECT_EQ(settings.denoise, DenoiseChoice::kOn);
    EXPECT_EQ(settings.exposure, 1.5f);
    EXPECT_EQ(settings.room, Room::kMatte);
    EXPECT_EQ(settings.lights, 2u);
    EXPECT_EQ(settings.background, (Background{{9, 8, 7}, false}));
    EXPECT_EQ(settings.reflectivity, 0.5f);
    Options options;
    options.choices.seed = 0;
    options.choices.shadows = options.choices.caustics = options.choices.blend = true;
    options.choices.denoise = DenoiseChoice::kAuto;
    options.choices.exposure = 0.0f;
    options.choices.room = Room::kNone;
    options.choices.lights = 0;
    options.choices.background = Background{};
    options.choices.reflectivity = 0.0f;
    settings = resolveSettings(options, talkativeScene());
    EXPECT_EQ(settings.seed, 0u);
    EXPECT_TRUE(settings.shadows && settings.caustics && settings.blend);
    EXPECT_EQ(settings.denoise, DenoiseChoice::kAuto);
    EXPECT_EQ(settings.exposure, 0);
    EXPECT_EQ(settings.room, Room::kNone);
    EXPECT_EQ(settings.lights, 0u);
    EXPECT_EQ(settings.background, Background{});
    EXPECT_EQ(settings.reflectivity, 0);
}

/// The message of a usage error; "" if there is no error.
std::string refusalOf(const Options& options, const SceneDescription& scene) {
    try {
        resolveSettings(options, scene);
    } catch (const Error& error) {
        EXPECT_EQ(error.code, ExitCode::kBadUsage);
        return error.what();
    }
    return "";
}

TEST(Settings, ColourOptionsNeedColorBy) {
    const auto refusal = [](const RenderChoices& said, const SceneDescription& scene) {
        Options options;
        options.scene = "scene.toml"; // a scan may be coloured by default
        options.choices = said;
        return refusalOf(options, scene);
    };
    RenderChoices map, range, legend, bare;
    map.color_map = ColorMap::kTurbo;
    range.color_range = ValueRange{0, 1};
    legend.legend = true;
    bare.legend = false;
    EXPECT_SAYS(refusal(map, {}), "--color-map: *--color-by");
    EXPECT_SAYS(refusal(range, {}), "--color-range: *needs --color-by");
    EXPECT_SAYS(refusal(legend, {}), "--legend: *--color-by");
    EXPECT_EQ(refusal(bare, {}), "") << "there is none";
    SceneDescription colored;
    colored.render.color_by = "height";
    EXPECT_EQ(refusal(map, colored), "");
    range.color_by = "class";
    EXPECT_EQ(refusal(range, {}), "");
    range.color_by = "normal";
    EXPECT_SAYS(refusal(range, {}), "--color-range: *--color-by normal");
    bare.color_by = "normal";
    EXPECT_EQ(refusal(bare, {}), "");
}

TEST(Settings, UseTheNamedView) {
    SceneDescription scene = talkativeScene();
    scene.path = "a.toml";
    Options options;
    const std::string standard = "*front, back, left, right, top, bottom, iso, sensor";
    options.view = "upper";
    const auto refusal = [&] { return refusalOf(options, scene); };
    EXPECT_SAYS(refusal(), "--view: a.toml *\"upper\"*none" + standard);
    scene.views.resize(2);
    scene.views[0].name = "front";
    scene.views[1].name = "side";
    EXPECT_SAYS(refusal(), "--view: a.toml *\"upper\"*front, side" + standard);
    options.view = "top";
    const CameraRequest above = resolveSettings(options, scene).camera;
    EXPECT_EQ(above.view, StandardView::kTop) << "every scene has the standard views";
    EXPECT_FALSE(above.eye) << "the scene's camera does not apply";
    scene.views[1] = {"top", {Vec3{0, 9, 0}, {}, {}, 30}};
    options.camera.target = Vec3{1, 1, 1};
    const CameraRequest camera = resolveSettings(options, scene).camera;
    EXPECT_EQ(camera.eye->y, 9);
    EXPECT_EQ(camera.target->y, 1) << "the command line's";
    EXPECT_EQ(camera.fov_deg, 30);
    EXPECT_FALSE(camera.up);
    EXPECT_EQ(resolveSettings({}, scene).camera.eye->y, 2) << "no view is requested";
}

TEST(Settings, CommandLineOverridesTheSceneFile) {
    Options options;
    options.choices.integrator = Integrator::kDepth;
    options.choices.bounces = 1;
    options.choices.spp = 2;
    options.choices.size = PixelSize{30, 20};
    options.fov_deg = 60;
    options.camera.eye = Vec3{7, 7, 7};
    const RenderSettings settings = resolveSettings(options, talkativeScene());
    EXPECT_EQ(settings.camera.eye->y, 7);
    EXPECT_EQ(settings.camera.target->y, 5) << "the file's";
    EXPECT_EQ(settings.camera.fov_deg, 60);
    EXPECT_EQ(settings.integrator, Integrator::kDepth);
    EXPECT_EQ(settings.bounces, 1u);
    EXPECT_EQ(settings.spp, 2u);
    EXPECT_EQ(settings.width, 30u);
    EXPECT_EQ(settings.height, 20u);
}

TEST(Settings, CommandLineOverridesTheProjection) {
    SceneDescription parallel;
    parallel.camera.ortho = true;
    parallel.camera.ortho_height = 3;
    EXPECT_EQ(resolveSettings({}, parallel).camera.ortho_height, 3);
    Options pinhole, fit;
    pinhole.fov_deg = 50;
    fit.camera.ortho = true;
    const CameraRequest wide = resolveSettings(pinhole, parallel).camera;
    EXPECT_EQ(wide.fov_deg, 50);
    EXPECT_FALSE(wide.ortho || wide.ortho_height);
    for (const SceneDescription& scene : {parallel, talkativeScene()}) {
        const CameraRequest all = resolveSettings(fit, scene).camera;
        EXPECT_TRUE(all.ortho && !all.ortho_height);
    }
}

TEST(Settings, AreDefaultsUnlessGiven) {
    const RenderSettings settings = resolveSettings({}, {}), defaults;
    EXPECT_EQ(settings.integrator, Integrator::kPhong);
    EXPECT_EQ(settings.spp, defaults.spp);
    EXPECT_EQ(settings.width, defaults.width);
    EXPECT_EQ(settings.camera.fov_deg, 40);
    EXPECT_FALSE(settings.camera.eye || settings.camera.target || settings.camera.up);
}

TEST(Settings, LimitsRaiseSamplesToTheMaximumUnlessGiven) {
    Options options;
    options.limits.noise = 0.1;
    EXPECT_EQ(resolveSettings(options, talkativeScene()).spp, kMaxSpp);
    options.choices.spp = 7;
    EXPECT_EQ(resolveSettings(options, talkativeScene()).spp, 7u);
}

TEST(Settings, DenoiseNoisyPngs) {
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
    scene.lights = {DiscLight{}};
    EXPECT_TRUE(wantsDenoising(options, settings, scene, 4));
    settings.integrator = Integrator::kNormal;
    EXPECT_FALSE(wantsDenoising(options, settings, scene, 4));
}

TEST(Settings, DoNotDenoiseGaussianCapturesAlone) {
    const StudioSubject gaussians{0.5, false, true};
    Options options;
    options.output = "a.png";
    RenderSettings settings;
    settings.integrator = Integrator::kPath;
    SceneDescription scene;
    EXPECT_FALSE(wantsDenoising(options, settings, scene, 4, gaussians));
    EXPECT_TRUE(wantsDenoising(options, settings, scene, 4)) << "scans scatter light";
    scene.shapes.resize(1);
    EXPECT_TRUE(wantsDenoising(options, settings, scene, 4, gaussians)) << "so do shapes";
    scene.shapes.clear();
    settings.denoise = DenoiseChoice::kOn;
    EXPECT_TRUE(wantsDenoising(options, settings, scene, 4, gaussians));
}

TEST(Settings, PicturesWithABackgroundHaveNoToneCurve) {
    SceneDescription scene;
    EXPECT_TRUE(toneMapping(scene, 2).compresses_highlights);
    EXPECT_EQ(toneMapping(scene, 2).stops, 2);
    RenderSettings settings;
    settings.background = Background{{255, 255, 255}, false};
    addSurroundings(scene, settings, {}, {-1, -1, -1}, {1, 1, 1});
    EXPECT_FALSE(toneMapping(scene, 0).compresses_highlights);
    EXPECT_FALSE(toneMapping(scene, 0).has_alpha);
    settings.background = Background{{}, true};
    addSurroundings(scene, settings, {}, {-1, -1, -1}, {1, 1, 1});
    EXPECT_FALSE(toneMapping(scene, 0).compresses_highlights);
    EXPECT_TRUE(toneMapping(scene, 0).has_alpha);
}

TEST(Settings, DoNotDenoiseExrsByDefault) {
    Options options;
    options.output = "a.exr";
    RenderSettings settings;
    settings.integrator = Integrator::kPath;
    EXPECT_FALSE(wantsDenoising(options, settings, {}, 4));
    settings.denoise = DenoiseChoice::kOn;
    EXPECT_TRUE(wantsDenoising(options, settings, {}, 1000));
    options.output = "a.png";
    settings.denoise = DenoiseChoice::kOff;
    EXPECT_FALSE(wantsDenoising(options, settings, {}, 4));
}

} // namespace
} // namespace pointrt

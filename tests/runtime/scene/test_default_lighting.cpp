// SPDX-License-Identifier: Apache-2.0
// The studio that surrounds scans by default, and plain backgrounds in its place.
#include "runtime/scene/default_lighting.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

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

TEST(Studio, BehindOpenGroundThePictureDarkensDownwards) {
    StudioSubject ground;
    ground.is_ground = ground.is_path_traced = true;
    SceneDescription scene;
    addSurroundings(scene, RenderSettings{}, Camera{}, kLow, kHigh, ground);
    ASSERT_TRUE(scene.sky);
    EXPECT_TRUE(scene.shapes.empty()) << "no floor";
    for (int c = 0; c < 3; ++c) EXPECT_NEAR(scene.sky->ground[c], 0.4 * scene.sky->horizon[c], 1e-6);
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

TEST(Studio, FloorsOfTiltedScenesTouchThem) {
    SceneDescription scene;
    scene.up = normalize(Vec3{1, 0, 1});
    Camera camera;
    camera.eye = {0, -10, 1};
    StudioSubject subject;
    subject.lowest = -0.25;
    addSurroundings(scene, RenderSettings{}, camera, kLow, kHigh, subject);
    EXPECT_NEAR(dot(scene.shapes.at(0).center, *scene.up), -0.25, 0.02);
}

float keyLight(const StudioSubject& subject) {
    SceneDescription scene;
    scene.up = Vec3{0, 0, 1};
    Camera camera;
    camera.eye = {0, -10, 1};
    addSurroundings(scene, RenderSettings{}, camera, kLow, kHigh, subject);
    return std::get<SunLight>(scene.lights.at(0)).irradiance[1];
}

TEST(Studio, MostlyDarkSubjectsGetMoreLightUntilTheirBrightPartsAreWhite) {
    StudioSubject subject;
    const float usual = keyLight(subject);
    subject.mean_reflectance = 0.09;
    subject.reflectance = 0.3;
    EXPECT_NEAR(keyLight(subject), 2 * usual, 1e-3 * usual);
    subject.reflectance = 0.6;
    EXPECT_NEAR(keyLight(subject), 1.25 * usual, 1e-3 * usual) << "0.6 becomes 0.75";
    subject.reflectance = 1;
    EXPECT_LT(keyLight(subject), usual) << "white parts";
}

/// The mean radiance of a sky above a level floor, weighted by the cosine, in many steps of the height.
double skyOnFloor(const SkyDescription& sky) {
    constexpr int kSteps = 10'000;
    double sum = 0;
    for (int i = 0; i < kSteps; ++i) {
        const double height = (i + 0.5) / kSteps;
        sum += 2 * height * (double{sky.horizon[1]} + std::sqrt(height) * double{sky.zenith[1] - sky.horizon[1]});
    }
    return sum / kSteps;
}

TEST(Studio, ForPathsTheFloorIsAsBrightAsTheHorizon) {
    SceneDescription scene;
    scene.up = Vec3{0, 0, 1};
    Camera camera;
    camera.eye = {0, -10, 1};
    StudioSubject subject;
    subject.is_path_traced = true;
    addSurroundings(scene, RenderSettings{}, camera, kLow, kHigh, subject);
    double light = skyOnFloor(*scene.sky);
    for (const auto& each : scene.lights) {
        const SunLight& lamp = std::get<SunLight>(each);
        light += double{lamp.irradiance[1]} * lamp.towards.z / std::numbers::pi;
    }
    const double floor = double{scene.materials.at(scene.shapes.at(0).material).color[1]};
    EXPECT_NEAR(floor * light, double{scene.sky->horizon[1]}, 1e-4);
    EXPECT_LT(floor, 0.3) << "darker than subjects";
}

TEST(Studio, LightsScenesThatNothingElseLights) {
    SceneDescription scene;
    RenderSettings settings;
    EXPECT_TRUE(isLitByDefault(scene, settings));
    settings.background = Background{};
    EXPECT_FALSE(isLitByDefault(scene, settings));
    settings.background.reset();
    settings.lights = 3;
    EXPECT_FALSE(isLitByDefault(scene, settings));
    settings.lights.reset();
    scene.render.room = Room::kMatte;
    EXPECT_FALSE(isLitByDefault(scene, settings));
}

TEST(Studio, InOneOfManyRoomsTheLampIsUnderItsCeiling) {
    SceneDescription scene;
    scene.up = Vec3{0, 0, 1};
    Camera camera;
    camera.eye = {2.5, 0, 0}; // far from the centre of the building
    StudioSubject subject{0.5, true};
    subject.walls = Surrounding{.covered = 1, .level = 1, .above = 1, .headroom = 0.4, .distance = 0.6};
    addSurroundings(scene, RenderSettings{}, camera, kLow, kHigh, subject);
    const PointLight& lamp = std::get<PointLight>(scene.lights.at(0));
    EXPECT_LT(length(lamp.position - camera.eye), 0.4);
    EXPECT_LT(lamp.position.z, camera.eye.z + 0.4);
    SceneDescription dark;
    dark.up = scene.up;
    subject.reflectance = 0.1;
    addSurroundings(dark, RenderSettings{}, camera, kLow, kHigh, subject);
    EXPECT_GT(std::get<PointLight>(dark.lights.at(0)).intensity[1], 2 * lamp.intensity[1])
        << "dark walls get more light";
}

constexpr Background kOrange{{255, 128, 0}, false};
constexpr bool kGaussians = true;

/// The scene with surroundings as seen from outside.
SceneDescription surrounded(SceneDescription scene, const RenderSettings& settings, bool only_gaussians) {
    scene.up = Vec3{0, 0, 1};
    Camera camera;
    camera.eye = {0, -10, 0};
    addSurroundings(scene, settings, camera, kLow, kHigh, {0.5, false, only_gaussians});
    return scene;
}

RenderSettings before(const Background& background) {
    RenderSettings settings;
    settings.background = background;
    return settings;
}

TEST(PlainBackground, IsTheSameColourInEveryDirection) {
    for (const bool gaussians : {false, true}) {
        const SkyDescription sky = surrounded({}, before(kOrange), gaussians).sky.value();
        EXPECT_EQ(sky.zenith, backgroundRadiance(kOrange));
        EXPECT_EQ(sky.horizon, sky.zenith);
        EXPECT_EQ(sky.ground, sky.zenith);
        EXPECT_EQ(sky.strength, 1);
    }
}

TEST(PlainBackground, ReplacesTheStudiosFloorButNotItsLamps) {
    const SceneDescription plain = surrounded({}, before(kOrange), !kGaussians);
    const SceneDescription studio = surrounded({}, {}, !kGaussians);
    EXPECT_TRUE(plain.shapes.empty());
    EXPECT_EQ(studio.shapes.size(), 1u);
    EXPECT_EQ(plain.lights, studio.lights);
    EXPECT_EQ(plain.sky->ambient, studio.sky->ambient);
    EXPECT_EQ(pictureBackground(plain), kOrange);
    EXPECT_FALSE(pictureBackground(studio));
}

TEST(PlainBackground, LightsNoGaussianCaptures) {
    RenderSettings settings = before(kOrange);
    for (const std::optional<Room> room : {std::optional<Room>(), std::optional(Room::kNone)}) {
        settings.room = room;
        const SceneDescription scene = surrounded({}, settings, kGaussians);
        EXPECT_TRUE(scene.lights.empty());
        EXPECT_TRUE(scene.shapes.empty());
        EXPECT_EQ(scene.sky->ambient, 0);
    }
    settings.lights = 2;
    EXPECT_EQ(surrounded({}, settings, kGaussians).lights.size(), 2u) << "requested";
    settings.lights.reset();
    settings.room = Room::kMatte;
    EXPECT_EQ(surrounded({}, settings, kGaussians).lights.size(), kRingLights) << "walls need some";
}

TEST(PlainBackground, KeepsTheLightsOfTheScene) {
    SceneDescription scene;
    scene.lights = {PointLight{}};
    const SceneDescription lit = surrounded(scene, before(kOrange), !kGaussians);
    EXPECT_EQ(lit.lights, scene.lights);
    EXPECT_EQ(lit.sky->ambient, 0);
    scene.lights.clear();
    scene.sky = SkyDescription{};
    scene.sky->image = "sky.hdr";
    scene.sky->strength = 7;
    scene.sky->ambient = 0.5f;
    const SceneDescription replaced = surrounded(scene, before(kOrange), !kGaussians);
    EXPECT_TRUE(replaced.lights.empty()) << "a scene with a sky gets no lamps";
    EXPECT_EQ(replaced.sky->image, "");
    EXPECT_EQ(replaced.sky->strength, 1);
    EXPECT_EQ(replaced.sky->ambient, 0.5f);
}

TEST(PlainBackground, IsBlackForGaussianCapturesAloneByDefault) {
    const SceneDescription scene = surrounded({}, {}, kGaussians);
    EXPECT_EQ(pictureBackground(scene), Background{});
    EXPECT_EQ(scene.sky->zenith, (Color{0, 0, 0}));
    EXPECT_TRUE(scene.lights.empty());
    EXPECT_TRUE(scene.shapes.empty());
}

TEST(PlainBackground, IsNoDefaultOnceAnythingElseIsChosen) {
    RenderSettings room, lights, unlit;
    room.room = Room::kNone;
    lights.lights = 0;
    unlit.integrator = Integrator::kNormal;
    for (const RenderSettings& settings : {room, lights, unlit})
        EXPECT_FALSE(pictureBackground(surrounded({}, settings, kGaussians)));
    SceneDescription lit, shaped, under_sky;
    lit.lights = {PointLight{}};
    shaped.shapes.resize(1);
    under_sky.sky = SkyDescription{};
    for (const SceneDescription& scene : {lit, shaped, under_sky})
        EXPECT_FALSE(pictureBackground(surrounded(scene, {}, kGaussians)));
}

TEST(PlainBackground, EndsWhenItsSkyIsEdited) {
    SceneDescription scene = surrounded({}, before(kOrange), kGaussians);
    RenderSettings settings;
    ownSurroundings(scene, settings);
    EXPECT_EQ(settings.background, kOrange);
    scene.sky->ground = {0, 1, 0};
    EXPECT_FALSE(pictureBackground(scene));
    ownSurroundings(scene, settings);
    EXPECT_FALSE(settings.background) << "the edited sky would be replaced";
}

} // namespace
} // namespace pointrt

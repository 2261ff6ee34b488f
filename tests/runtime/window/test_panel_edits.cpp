// SPDX-License-Identifier: Apache-2.0
// Editing of lights and materials, and number formatting.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "runtime/window/edit/light_edit.h"
#include "runtime/window/edit/material_edit.h"
#include "runtime/window/ui/panel_numbers.h"

namespace pointrt {
namespace {

constexpr Vec3 kUp{0, 1, 0};
const LitScene kScene{{1, 2, 3}, kUp, 4, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}};

template <typename L>
L newLightOf() {
    return std::get<L>(newLight(LightDescription(L{}).index(), kScene));
}

void expectSameVector(Vec3 a, Vec3 b, double tolerance = 1e-9) { EXPECT_LT(length(a - b), tolerance); }

TEST(LightEdit, BrightnessOneIsWhite) {
    // The radiance of a white surface is irradiance / pi. At distance 10 a point of intensity 100 pi gives an
    // irradiance of pi; so does the sun; a sphere of radius 1 and a square of area 4 with radiance 100 give 100 pi /
    // 100 and 100 * 4 / 100.
    const auto pi = std::numbers::pi_v<float>;
    EXPECT_NEAR(brightnessOf(PointLight{{}, {100 * pi, 0, 0}}, 10), 1, 1e-6);
    EXPECT_NEAR(brightnessOf(SunLight{kUp, 0, {0, pi, 0}}, 10), 1, 1e-6);
    EXPECT_NEAR(brightnessOf(SphereLight{{}, 1, {0, 0, 100}, true}, 10), 1, 1e-6);
    EXPECT_NEAR(brightnessOf(QuadLight{{}, {1, 0, 0}, {0, 1, 0}, {100, 0, 0}, true}, 10), 4 / std::numbers::pi, 1e-6);
}

TEST(LightEdit, BrightnessOfADisc) {
    // its area is pi
    EXPECT_NEAR(brightnessOf(DiscLight{{}, kUp, 1, {100, 0, 0}, true}, 10), 1, 1e-6);
    auto disc = newLightOf<DiscLight>();
    expectSameVector(disc.normal, normalize(kScene.centre - disc.center));
    resize(disc, [&] { disc.radius *= 3; });
    EXPECT_NEAR(brightnessOf(disc, 8), 0.7, 1e-6);
}

TEST(LightEdit, TintAndBrightnessAreSeparate) {
    for (std::size_t kind = 0; kind < kLightKinds; ++kind) {
        LightDescription light = newLight(kind, kScene);
        EXPECT_EQ(light.index(), kind);
        EXPECT_NEAR(brightnessOf(light, 8), 0.7, 1e-6);
        setTint(light, {0.5f, 0.25f, 0});
        EXPECT_NEAR(brightnessOf(light, 8), 0.7, 1e-6);
        setBrightness(light, 3, 8);
        EXPECT_NEAR(brightnessOf(light, 8), 3, 1e-5);
        EXPECT_NEAR(tintOf(light)[0], 1, 1e-6);
        EXPECT_NEAR(tintOf(light)[1], 0.5, 1e-6);
        EXPECT_EQ(tintOf(light)[2], 0);
    }
}

TEST(LightEdit, StaysWithinSceneFileLimits) {
    LightDescription light = PointLight{{}, {1, 1, 1}};
    setBrightness(light, 1e30, 1e12);
    EXPECT_LE(emissionOf(light)[0], 1.0001e12f);
    setTint(light, {0, 0, 0});
    EXPECT_GT(emissionOf(light)[0], 0);
    setBrightness(light, 0, 1);
    EXPECT_EQ(tintOf(light), (Color{1, 1, 1}));
}

TEST(LightEdit, ResizingKeepsTheBrightness) {
    auto sphere = newLightOf<SphereLight>();
    auto quad = newLightOf<QuadLight>();
    resize(sphere, [&] { sphere.radius = 3; });
    resize(quad, [&] {
        quad.u = 3 * normalize(quad.u);
        quad.v = 0.1 * normalize(quad.v);
    });
    EXPECT_NEAR(brightnessOf(sphere, 8), 0.7, 1e-6);
    EXPECT_NEAR(brightnessOf(quad, 8), 0.7, 1e-6);
}

TEST(LightEdit, NewLightsFaceTheScene) {
    const auto towards = [](Vec3 from) { return normalize(kScene.centre - from); };
    const auto spot = newLightOf<SpotLight>();
    expectSameVector(spot.direction, towards(spot.position));
    EXPECT_NEAR(spot.outer_deg, 30, 1e-9); // the scene's sphere at a distance of twice its radius
    const auto quad = newLightOf<QuadLight>();
    expectSameVector(quad.facing(), towards(quad.center));
    EXPECT_NEAR(dot(quad.u, quad.v), 0, 1e-9);
    EXPECT_NEAR(quad.u.y, 0, 1e-9);
    const auto sun = newLightOf<SunLight>();
    expectSameVector(sun.towards, normalize(Vec3{-1, 1, 1}));
}

TEST(LightEdit, BearingsAreAzimuthAndElevation) {
    expectSameVector(directionOf({0, 0}, kUp), {0, 0, -1});
    expectSameVector(directionOf({90, 0}, kUp), {1, 0, 0});
    expectSameVector(directionOf({90, 90}, kUp), kUp);
    for (const Vec3 up : {kUp, Vec3{0, 0, 1}, normalize(Vec3{1, 2, -3})})
        for (const double azimuth : {0.0, 10.0, 179.0, 359.0})
            for (const double height : {-80.0, 0.0, 45.0}) {
                const Bearing bearing = bearingOf(5 * directionOf({azimuth, height}, up), up);
                EXPECT_NEAR(bearing.azimuth_deg, azimuth, 1e-9);
                EXPECT_NEAR(bearing.elevation_deg, height, 1e-9);
            }
    EXPECT_EQ(bearingOf({}, kUp).elevation_deg, 90);
    EXPECT_EQ(bearingOf({0, -2, 0}, kUp).elevation_deg, -90);
}

TEST(LightEdit, AimsASoftboxStraightDown) {
    QuadLight light{{}, {2, 0, 0}, {0, 3, 0}, {1, 1, 1}, true};
    light.face({0, -1, 0}, kUp);
    expectSameVector(light.facing(), {0, -1, 0});
    EXPECT_NEAR(length(light.u), 2, 1e-9);
    EXPECT_NEAR(length(light.v), 3, 1e-9);
}

SceneDescription threeScans() {
    SceneDescription scene;
    scene.materials.resize(2);
    scene.materials[0].name = "floor";
    scene.materials[1].name = "gold";
    scene.instances.resize(3);
    scene.instances[0].material = scene.instances[1].material = 1;
    scene.shapes.resize(1);
    return scene;
}

TEST(MaterialEdit, KeepsSharedMaterials) {
    SceneDescription scene = threeScans();
    ASSERT_TRUE(setScanMaterial(scene, {0, 1}, MaterialKind::kGlass));
    EXPECT_EQ(scene.instances[0].material, 2u);
    EXPECT_EQ(scene.instances[1].material, 1u);
    EXPECT_EQ(scene.materials[1].kind, MaterialKind::kMatte);
    EXPECT_EQ(scene.materials[2].kind, MaterialKind::kGlass);
    ASSERT_TRUE(setScanMaterial(scene, {1, 1}, MaterialKind::kMetal)); // it has its own material now
    EXPECT_EQ(scene.instances[1].material, 1u);
    EXPECT_EQ(scene.materials[1].kind, MaterialKind::kMetal);
    EXPECT_EQ(scene.materials[1].name, "gold");
    EXPECT_FALSE(scene.instances[2].material.has_value());
    scene.instances[2].material = 0; // the material of the floor
    ASSERT_TRUE(setScanMaterial(scene, {2, 1}, MaterialKind::kMirror));
    EXPECT_NE(scene.instances[2].material, 0u);
    EXPECT_EQ(scene.materials[0].kind, MaterialKind::kMatte);
}

TEST(MaterialEdit, ReusesMaterials) {
    SceneDescription scene = threeScans();
    for (int turn = 0; turn < 10; ++turn) {
        ASSERT_TRUE(setScanMaterial(scene, {0, 3}, MaterialKind::kMirror));
        ASSERT_TRUE(setScanMaterial(scene, {0, 3}, std::nullopt));
        ASSERT_TRUE(setScanMaterial(scene, {2, 1}, MaterialKind::kPlastic));
    }
    EXPECT_LE(scene.materials.size(), 3u);
}

TEST(MaterialEdit, RespectsTheMaterialLimit) {
    SceneDescription scene = threeScans();
    scene.materials.resize(256);
    const SceneDescription before = scene;
    EXPECT_FALSE(setScanMaterial(scene, {2, 1}, MaterialKind::kGlass));
    EXPECT_EQ(scene, before);
    EXPECT_TRUE(setScanMaterial(scene, {0, 1}, std::nullopt));
}

TEST(MaterialEdit, NamesAreUnique) {
    SceneDescription scene = threeScans();
    for (std::size_t i = 0; i < 3; ++i) ASSERT_TRUE(setScanMaterial(scene, {i, 1}, MaterialKind::kPlastic));
    std::vector<std::string> names;
    for (const MaterialDescription& material : scene.materials) names.push_back(material.name);
    std::sort(names.begin(), names.end());
    EXPECT_EQ(std::adjacent_find(names.begin(), names.end()), names.end());
}

TEST(PanelNumbers, HaveSensibleDigits) {
    EXPECT_EQ(lengthText(0.123456789, 0.27), "0.12346");
    EXPECT_EQ(lengthText(4512345.678912, 120), "4512345.68");
    EXPECT_EQ(lengthText(-3.7, 1e6), "-4");
    EXPECT_EQ(lengthText(1e30, 1), "1e+30");
    EXPECT_EQ(lengthText(NAN, 1).find("nan") != std::string::npos, true);
    EXPECT_EQ(decimalsFor(NAN), 3);
    EXPECT_EQ(countText(0), "0");
    EXPECT_EQ(countText(999), "999");
    EXPECT_EQ(countText(1000), "1 000");
    EXPECT_EQ(countText(12345678), "12 345 678");
    EXPECT_EQ(bytesText(999), "999 B");
    EXPECT_EQ(bytesText(1500), "1.5 kB");
    EXPECT_EQ(bytesText(231000000), "231 MB");
    EXPECT_EQ(bytesText(~0ull), "18 EB");
}

} // namespace
} // namespace pointrt

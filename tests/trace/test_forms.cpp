// SPDX-License-Identifier: Apache-2.0
// The fused passes and the queued ones trace the same rays: pictures differ by rounding alone.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <string>

#include "tests/trace/render_helper.h"

namespace pointrt::test {
namespace {

constexpr std::uint32_t kSize = 64;
constexpr std::size_t kSplats = 20'000;

RenderSettings pathSettings() {
    RenderSettings settings = square(kSize);
    settings.integrator = Integrator::kPath;
    settings.spp = 4;
    settings.camera.eye = Vec3{0.5, 1.5, 5};
    settings.camera.target = Vec3{0, 0, 0};
    return settings;
}

MaterialDescription ofKind(MaterialKind kind) {
    MaterialDescription material;
    material.kind = kind;
    return material;
}

/// Balls of splats and of shapes over a floor, a pair of each kind of material.
SceneDescription allMaterials(const std::string& ball) {
    SceneDescription scene;
    for (const MaterialKind kind : {MaterialKind::kMatte, MaterialKind::kMetal, MaterialKind::kPlastic,
                                    MaterialKind::kMirror, MaterialKind::kGlass}) {
        const auto number = static_cast<std::uint32_t>(scene.materials.size());
        const double x = 1.1 * number - 2.2;
        scene.materials.push_back(ofKind(kind));
        InstanceDescription instance{ball, {}, {}, {}};
        instance.placement.scale = 0.5;
        instance.placement.translation = {x, -0.5, 0};
        instance.material = number;
        scene.instances.push_back(instance);
        scene.shapes.push_back({ShapeKind::kSphere, {x, 0.6, -0.5}, {0.5, 0, 0}, {0, 0.5, 0}, {0, 0, 0.5}, number});
    }
    scene.shapes.push_back({ShapeKind::kPlane, {0, -1, 0}, {1, 0, 0}, {0, 0, -1}, {0, 1, 0}, 0});
    return scene;
}

SceneDescription allLights(const std::string& ball) {
    SceneDescription scene = allMaterials(ball);
    scene.lights = {PointLight{{-2, 3, 2}, {10, 10, 10}}, SphereLight{{2, 4, 2}, 0.5, {30, 20, 10}},
                    QuadLight{{0, 4, 0}, {1, 0, 0}, {0, 0, 1}, {5, 5, 9}},
                    DiscLight{{-3, 2, 0}, {1, 0, 0}, 0.5, {9, 9, 9}}};
    scene.sky = evenSky(0.3f);
    return scene;
}

/// How far two films are apart.
struct Apart {
    double mean = 0;        ///< of the channels' differences, over the mean channel
    std::size_t pixels = 0; ///< more than a thousandth off: paths that rounding sent elsewhere
};

Apart apart(const Film& a, const Film& b) {
    Apart result;
    double sum = 0, all = 0;
    for (std::size_t i = 0; i < a.rgba.size(); ++i) {
        const double difference = std::abs(double{a.rgba[i]} - b.rgba[i]);
        sum += difference;
        all += b.rgba[i];
        result.pixels += difference > 1e-3 * std::max(1.0, double{b.rgba[i]}) ? 1 : 0;
    }
    result.mean = sum / all;
    return result;
}

/// What photons bring, in the mean of all channels.
double meanCaustic(const Film& film) {
    return std::accumulate(film.caustic.begin(), film.caustic.end(), 0.0) / static_cast<double>(film.caustic.size());
}

void expectAlike(const SceneDescription& scene, const RenderSettings& settings) {
    const Rendered queued = renderScene(scene, settings, PassForm::kQueued);
    const Rendered fused = renderScene(scene, settings, PassForm::kFused);
    ASSERT_EQ(queued.form, PassForm::kQueued);
    ASSERT_EQ(fused.form, PassForm::kFused);
    const Apart rgba = apart(fused.film, queued.film);
    // a path that goes elsewhere moves its pixel by a quarter of what it is
    EXPECT_LE(rgba.pixels, kSize * kSize / 1000);
    EXPECT_LT(rgba.mean, rgba.pixels > 0 ? 1e-3 : 1e-6);
    EXPECT_EQ(fused.film.depth, queued.film.depth);
    EXPECT_EQ(fused.rays.primary, queued.rays.primary);
    EXPECT_NEAR(static_cast<double>(fused.rays.secondary), static_cast<double>(queued.rays.secondary), 8);
    EXPECT_NEAR(static_cast<double>(fused.rays.shadow), static_cast<double>(queued.rays.shadow), 8);
}

class Forms : public testing::Test {
protected:
    SphereFile ball{kSplats};
};

TEST_F(Forms, AreAlikeInAMatteRoom) {
    SceneDescription scene;
    scene.instances.push_back({ball.path, {}, {}, {}});
    RenderSettings settings = pathSettings();
    settings.room = Room::kMatte;
    expectAlike(scene, settings);
    settings.blend = false;
    settings.shadows = false;
    expectAlike(scene, settings);
}

TEST_F(Forms, AreAlikeWithoutInstances) {
    SceneDescription scene = allLights(ball.path);
    scene.instances.clear();
    expectAlike(scene, pathSettings());
}

TEST_F(Forms, AreAlikeOfAllMaterials) { expectAlike(allMaterials(ball.path), pathSettings()); }

TEST_F(Forms, AreAlikeUnderAllLights) { expectAlike(allLights(ball.path), pathSettings()); }

TEST_F(Forms, AreAlikeWithCaustics) {
    RenderSettings settings = pathSettings();
    settings.light_parts = true;
    const Film queued = renderScene(allLights(ball.path), settings, PassForm::kQueued).film;
    const Film fused = renderScene(allLights(ball.path), settings, PassForm::kFused).film;
    ASSERT_GT(meanCaustic(queued), 1e-3);
    EXPECT_NEAR(meanCaustic(fused), meanCaustic(queued), 1e-4 * meanCaustic(queued));
    settings.caustics = false;
    expectAlike(allLights(ball.path), settings);
}

TEST_F(Forms, AreAlikeUnderASkyImage) {
    SceneDescription scene = allMaterials(ball.path);
    scene.sky = evenSky(1);
    scene.sky->image = writeSky("forms.exr", 16, directionColor);
    expectAlike(scene, pathSettings());
}

TEST_F(Forms, AreAlikeThroughPixelCentres) {
    RenderSettings settings = pathSettings();
    settings.spp = 1;
    settings.bounces = 0;
    expectAlike(allMaterials(ball.path), settings);
    settings.bounces = 12;
    expectAlike(allMaterials(ball.path), settings);
}

TEST_F(Forms, FusedPicturesAreTheSameEachTime) {
    const RenderSettings settings = pathSettings();
    const Film first = renderScene(allLights(ball.path), settings, PassForm::kFused).film;
    for (int i = 0; i < 2; ++i)
        EXPECT_EQ(renderScene(allLights(ball.path), settings, PassForm::kFused).film.rgba, first.rgba);
    EXPECT_EQ(renderScene(allLights(ball.path), settings, PassForm::kFused, true).film.rgba, first.rgba) << "in steps";
}

} // namespace
} // namespace pointrt::test

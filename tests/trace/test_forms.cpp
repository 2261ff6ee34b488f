// SPDX-License-Identifier: Apache-2.0
// The fused passes and the queued ones trace the same rays: pictures differ by rounding alone.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <numeric>
#include <string>

#include "tests/trace/render_helper.h"

namespace pointrt::test {
namespace {

constexpr std::uint32_t kFormsSize = 64;
constexpr std::size_t kSplats = 20'000;

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
    const Rendered queued = renderScene(scene, settings, KernelForm::kWavefront);
    const Rendered fused = renderScene(scene, settings, KernelForm::kMegakernel);
    ASSERT_EQ(queued.form, KernelForm::kWavefront);
    ASSERT_EQ(fused.form, KernelForm::kMegakernel);
    const Apart rgba = apart(fused.film, queued.film);
    // a path that goes elsewhere moves its pixel by a quarter of what it is
    EXPECT_LE(rgba.pixels, kFormsSize * kFormsSize / 1000);
    EXPECT_LT(rgba.mean, rgba.pixels > 0 ? 1e-3 : 1e-6);
    EXPECT_EQ(fused.film.depth, queued.film.depth);
    EXPECT_EQ(fused.rays.primary, queued.rays.primary);
    EXPECT_NEAR(static_cast<double>(fused.rays.secondary), static_cast<double>(queued.rays.secondary), 8);
    EXPECT_NEAR(static_cast<double>(fused.rays.shadow), static_cast<double>(queued.rays.shadow), 8);
}

/// Those that show light.
class Forms : public testing::TestWithParam<Integrator> {
protected:
    RenderSettings settingsOf() const {
        RenderSettings settings = square(kFormsSize);
        settings.integrator = GetParam();
        settings.spp = 4;
        settings.camera.eye = Vec3{0.5, 1.5, 5};
        settings.camera.target = Vec3{0, 0, 0};
        return settings;
    }

    SphereFile ball{kSplats};
};

TEST_P(Forms, AreAlikeWithoutInstances) {
    SceneDescription scene = allLights(ball.path);
    scene.instances.clear();
    expectAlike(scene, settingsOf());
}

TEST_P(Forms, AreAlikeOfAllMaterials) { expectAlike(allMaterials(ball.path), settingsOf()); }

TEST_P(Forms, AreAlikeUnderAllLights) { expectAlike(allLights(ball.path), settingsOf()); }

TEST_P(Forms, AreAlikeWithCaustics) {
    RenderSettings settings = settingsOf();
    settings.light_parts = true;
    const Film queued = renderScene(allLights(ball.path), settings, KernelForm::kWavefront).film;
    const Film fused = renderScene(allLights(ball.path), settings, KernelForm::kMegakernel).film;
    ASSERT_GT(meanCaustic(queued), 1e-3);
    EXPECT_NEAR(meanCaustic(fused), meanCaustic(queued), 1e-4 * meanCaustic(queued));
    settings.caustics = false;
    expectAlike(allLights(ball.path), settings);
}

TEST_P(Forms, AreAlikeUnderASkyImage) {
    SceneDescription scene = allMaterials(ball.path);
    scene.sky = evenSky(1);
    scene.sky->image = writeSky("forms.exr", 16, directionColor);
    expectAlike(scene, settingsOf());
    std::remove(scene.sky->image.c_str());
}

TEST_P(Forms, AreAlikeThroughPixelCentres) {
    RenderSettings settings = settingsOf();
    settings.spp = 1;
    settings.bounces = 0;
    expectAlike(allMaterials(ball.path), settings);
    settings.bounces = 12;
    expectAlike(allMaterials(ball.path), settings);
}

/// Shapes alone: paths never leave registers for an instance, but lavapipe would end the loop over so many shapes,
/// lights and bounces.
TEST_P(Forms, AreAlikeOfLongPathsAmongManyShapes) {
    SceneDescription scene = allLights(ball.path);
    scene.instances.clear();
    for (int i = 0; i < 4; ++i) scene.lights.push_back(PointLight{{-1.0 * i, 3, 2}, {1, 1, 1}});
    const auto mirror = static_cast<std::uint32_t>(MaterialKind::kMirror);
    scene.shapes.push_back({ShapeKind::kBox, {0, 1, 0}, {7, 0, 0}, {0, 7, 0}, {0, 0, 7}, mirror});
    while (scene.shapes.size() < 60) {
        const double x = 0.1 * static_cast<double>(scene.shapes.size()) - 3;
        scene.shapes.push_back({ShapeKind::kSphere, {x, -0.8, 1}, {0.05, 0, 0}, {0, 0.05, 0}, {0, 0, 0.05}, 3});
    }
    RenderSettings settings = settingsOf();
    settings.bounces = 64;
    settings.spp = 1;
    settings.caustics = false;
    expectAlike(scene, settings);
}

TEST_P(Forms, FusedPicturesAreTheSameEachTime) {
    const RenderSettings settings = settingsOf();
    const Film first = renderScene(allLights(ball.path), settings, KernelForm::kMegakernel).film;
    for (int i = 0; i < 2; ++i)
        EXPECT_EQ(renderScene(allLights(ball.path), settings, KernelForm::kMegakernel).film.rgba, first.rgba);
    EXPECT_EQ(renderScene(allLights(ball.path), settings, KernelForm::kMegakernel, 16).film.rgba, first.rgba)
        << "in steps";
}

/// Frames are cut into few rows where they take long: what is seen may not depend on time.
TEST(Strips, OfPartsOfTilesShowTheSame) {
    const SphereFile ball(20000);
    SceneDescription scene;
    scene.instances.push_back({ball.path, {}, {}, {}});
    RenderSettings settings = square(256);
    settings.camera.eye = Vec3{20, 50, 30}; // so far that where a ray starts decides on its last bits
    settings.camera.target = Vec3{0, 0, 0};
    settings.camera.fov_deg = 2;
    const Film whole = renderScene(scene, settings).film;
    for (const std::uint32_t rows : {1u, 5u, 21u}) {
        const Film cut = renderScene(scene, settings, {}, rows).film;
        EXPECT_EQ(cut.rgba, whole.rgba) << rows;
        EXPECT_EQ(cut.depth, whole.depth) << rows;
    }
}

/// Where no path goes on, but with path itself: points are asked for light in the same go.
class FormsOfMatte : public Forms {};

TEST_P(FormsOfMatte, AreAlikeInAMatteRoom) {
    SceneDescription scene;
    scene.instances.push_back({ball.path, {}, {}, {}});
    RenderSettings settings = settingsOf();
    settings.room = Room::kMatte;
    expectAlike(scene, settings);
    settings.blend = false;
    settings.shadows = false;
    expectAlike(scene, settings);
}

TEST_P(FormsOfMatte, AreAlikeUnderFewAndUnderManyLights) {
    SceneDescription scene = allLights(ball.path);
    for (MaterialDescription& each : scene.materials) each = ofKind(MaterialKind::kMatte);
    expectAlike(scene, settingsOf());
    for (int i = 0; i < 8; ++i) scene.lights.push_back(PointLight{{i - 4.0, 3, 2}, {1, 1, 1}});
    expectAlike(scene, settingsOf());
}

std::string nameOfParam(const testing::TestParamInfo<Integrator>& each) { return nameOf(kIntegratorNames, each.param); }

INSTANTIATE_TEST_SUITE_P(Integrators, Forms, testing::Values(Integrator::kWhitted, Integrator::kPath), nameOfParam);
INSTANTIATE_TEST_SUITE_P(Integrators, FormsOfMatte, testing::Values(Integrator::kPhong, Integrator::kPath),
                         nameOfParam);

} // namespace
} // namespace pointrt::test

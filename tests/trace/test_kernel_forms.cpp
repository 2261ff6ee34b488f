// SPDX-License-Identifier: Apache-2.0
// Megakernel and wavefront trace the same rays: pictures differ only by rounding.
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

/// The difference of two films.
struct Apart {
    double mean = 0;        ///< of the channels' differences, relative to the mean of the channels
    std::size_t pixels = 0; ///< pixels that differ by more than a thousandth: rounding sent their paths elsewhere
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

/// Mean contribution of photons over all channels.
double meanCaustic(const Film& film) {
    return std::accumulate(film.caustic.begin(), film.caustic.end(), 0.0) / static_cast<double>(film.caustic.size());
}

void expectAgreement(const SceneDescription& scene, const RenderSettings& settings) {
    const Rendered wavefront = renderScene(scene, settings, KernelForm::kWavefront);
    const Rendered megakernel = renderScene(scene, settings, KernelForm::kMegakernel);
    ASSERT_EQ(wavefront.form, KernelForm::kWavefront);
    ASSERT_EQ(megakernel.form, KernelForm::kMegakernel);
    const Apart rgba = apart(megakernel.film, wavefront.film);
    // if one of four paths goes elsewhere, its pixel changes by a quarter
    EXPECT_LE(rgba.pixels, kFormsSize * kFormsSize / 1000);
    EXPECT_LT(rgba.mean, rgba.pixels > 0 ? 1e-3 : 1e-6);
    EXPECT_EQ(megakernel.film.depth, wavefront.film.depth);
    EXPECT_EQ(megakernel.rays.primary, wavefront.rays.primary);
    EXPECT_NEAR(static_cast<double>(megakernel.rays.secondary), static_cast<double>(wavefront.rays.secondary), 8);
    EXPECT_NEAR(static_cast<double>(megakernel.rays.shadow), static_cast<double>(wavefront.rays.shadow), 8);
}

/// With integrators that show light.
class KernelForms : public testing::TestWithParam<Integrator> {
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

TEST_P(KernelForms, AgreeWithoutInstances) {
    SceneDescription scene = allLights(ball.path);
    scene.instances.clear();
    expectAgreement(scene, settingsOf());
}

TEST_P(KernelForms, AgreeOnAllMaterials) { expectAgreement(allMaterials(ball.path), settingsOf()); }

TEST_P(KernelForms, AgreeUnderAllLights) { expectAgreement(allLights(ball.path), settingsOf()); }

TEST_P(KernelForms, AgreeOnCaustics) {
    RenderSettings settings = settingsOf();
    settings.light_parts = true;
    const Film wavefront = renderScene(allLights(ball.path), settings, KernelForm::kWavefront).film;
    const Film megakernel = renderScene(allLights(ball.path), settings, KernelForm::kMegakernel).film;
    ASSERT_GT(meanCaustic(wavefront), 1e-3);
    EXPECT_NEAR(meanCaustic(megakernel), meanCaustic(wavefront), 1e-4 * meanCaustic(wavefront));
    settings.caustics = false;
    expectAgreement(allLights(ball.path), settings);
}

TEST_P(KernelForms, AgreeUnderASkyImage) {
    SceneDescription scene = allMaterials(ball.path);
    scene.sky = evenSky(1);
    scene.sky->image = writeSky("forms.exr", 16, directionColor);
    expectAgreement(scene, settingsOf());
    std::remove(scene.sky->image.c_str());
}

TEST_P(KernelForms, AgreeThroughPixelCentres) {
    RenderSettings settings = settingsOf();
    settings.spp = 1;
    settings.bounces = 0;
    expectAgreement(allMaterials(ball.path), settings);
    settings.bounces = 12;
    expectAgreement(allMaterials(ball.path), settings);
}

/// Only shapes: without instances paths never leave registers, but lavapipe would abort a loop over so many shapes,
/// lights and bounces.
TEST_P(KernelForms, AgreeOnLongPathsAmongManyShapes) {
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
    expectAgreement(scene, settings);
}

TEST_P(KernelForms, MegakernelIsDeterministic) {
    const RenderSettings settings = settingsOf();
    const Film first = renderScene(allLights(ball.path), settings, KernelForm::kMegakernel).film;
    for (int i = 0; i < 2; ++i)
        EXPECT_EQ(renderScene(allLights(ball.path), settings, KernelForm::kMegakernel).film.rgba, first.rgba);
    EXPECT_EQ(renderScene(allLights(ball.path), settings, KernelForm::kMegakernel, 16).film.rgba, first.rgba)
        << "in strips";
}

/// Slow frames are traced in strips of few rows, which must not change the picture.
TEST(Strips, PartsOfTilesGiveTheSamePicture) {
    const SphereFile ball(20000);
    SceneDescription scene;
    scene.instances.push_back({ball.path, {}, {}, {}});
    RenderSettings settings = square(256);
    settings.camera.eye = Vec3{20, 50, 30}; // so far away that the last bits depend on where rays start
    settings.camera.target = Vec3{0, 0, 0};
    settings.camera.fov_deg = 2;
    const Film whole = renderScene(scene, settings).film;
    for (const std::uint32_t rows : {1u, 5u, 21u}) {
        const Film cut = renderScene(scene, settings, {}, rows).film;
        EXPECT_EQ(cut.rgba, whole.rgba) << rows;
        EXPECT_EQ(cut.depth, whole.depth) << rows;
    }
}

/// Scenes in which only the path integrator has secondary rays: other paths get their light in the same pass.
class MatteKernelForms : public KernelForms {};

TEST_P(MatteKernelForms, AgreeInAMatteRoom) {
    SceneDescription scene;
    scene.instances.push_back({ball.path, {}, {}, {}});
    RenderSettings settings = settingsOf();
    settings.room = Room::kMatte;
    expectAgreement(scene, settings);
    settings.blend = false;
    settings.shadows = false;
    expectAgreement(scene, settings);
}

TEST_P(MatteKernelForms, AgreeUnderFewAndManyLights) {
    SceneDescription scene = allLights(ball.path);
    for (MaterialDescription& each : scene.materials) each = ofKind(MaterialKind::kMatte);
    expectAgreement(scene, settingsOf());
    for (int i = 0; i < 8; ++i) scene.lights.push_back(PointLight{{i - 4.0, 3, 2}, {1, 1, 1}});
    expectAgreement(scene, settingsOf());
}

std::string nameOfParam(const testing::TestParamInfo<Integrator>& each) { return nameOf(kIntegratorNames, each.param); }

INSTANTIATE_TEST_SUITE_P(Integrators, KernelForms, testing::Values(Integrator::kWhitted, Integrator::kPath),
                         nameOfParam);
INSTANTIATE_TEST_SUITE_P(Integrators, MatteKernelForms, testing::Values(Integrator::kPhong, Integrator::kPath),
                         nameOfParam);

} // namespace
} // namespace pointrt::test

// SPDX-License-Identifier: Apache-2.0
// The integrator ambient against what its definition (shaders/shade/ambient.glsl) gives in simple places.
#include <gtest/gtest.h>

#include <cmath>

#include "tests/trace/render_helper.h"

namespace pointrt::test {
namespace {

constexpr float kAlbedo = 0.6f;

MaterialDescription greyMatte() {
    MaterialDescription material;
    material.color = {kAlbedo, kAlbedo, kAlbedo};
    return material;
}

RenderSettings ambient(std::uint32_t size, std::uint32_t spp) {
    RenderSettings settings = square(size);
    settings.integrator = Integrator::kAmbient;
    settings.spp = spp;
    settings.lights = 0;
    return settings;
}

double meanOf(const Film& film) {
    double sum = 0;
    for (std::size_t i = 0; i < film.samples.size(); ++i) sum += double{film.rgba[4 * i]};
    return sum / static_cast<double>(film.samples.size());
}

/// From the middle of a sphere every surface faces the eye, at distance 1. With a field of view of 90 degrees the
/// picture is 2 high there, so rays reach up to a quarter of that, 0.5, evenly spread. The far side lies 2 cos away:
/// the probability that a ray ends before it is min(1, 4 cos), whose mean over cosine-weighted directions is 8/3 / 64 +
/// 1 - 1/16 = 0.97917.
TEST(Ambient, LeavesTheLightOfASphereThatRaysDoNotCross) {
    RenderSettings settings = ambient(32, 64);
    settings.camera.eye = Vec3{0, 0, 0};
    settings.camera.target = Vec3{0, 0, -1};
    settings.camera.fov_deg = 90;
    const SceneDescription sphere = analyticSphere(greyMatte());
    for (const KernelForm form : {KernelForm::kMegakernel, KernelForm::kWavefront}) {
        const Rendered rendered = renderScene(sphere, settings, form);
        // 65,536 rays: a standard deviation of 0.0006 of the mean
        EXPECT_NEAR(meanOf(rendered.film) / double{kAlbedo}, 0.97917, 0.003) << static_cast<int>(form);
    }
    settings.shadows = false;
    EXPECT_NEAR(meanOf(renderScene(sphere, settings).film), double{kAlbedo}, 1e-5);
}

/// A disc alone is lit by its surroundings from everywhere; it darkens to 0.55 as it turns from the eye.
TEST(Ambient, DarkensWhatTurnsFromTheEye) {
    SceneDescription scene;
    scene.materials = {greyMatte()};
    ShapeDescription disc{ShapeKind::kDisc, {0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}, 0};
    scene.shapes = {disc};
    RenderSettings settings = ambient(8, 1);
    settings.camera.ortho_height = 0.2;
    for (const double degrees : {0.0, 60.0}) {
        const double radians = degrees * 3.14159265358979 / 180;
        settings.camera.eye = Vec3{5 * std::sin(radians), 0, 5 * std::cos(radians)};
        settings.camera.target = Vec3{0, 0, 0};
        const double expected = double{kAlbedo} * (0.55 + 0.45 * std::cos(radians));
        EXPECT_NEAR(meanOf(renderScene(scene, settings).film), expected, 1e-4) << degrees;
    }
}

/// Lamps change nothing: there is no light but that of the surroundings.
TEST(Ambient, UsesNoLights) {
    const SphereFile sphere(3000);
    SceneDescription scene = splatBody(sphere.path, greyMatte());
    const RenderSettings settings = ambient(24, 4);
    const Rendered dark = renderScene(scene, settings);
    PointLight lamp;
    lamp.position = {0, 5, 5};
    lamp.intensity = {100, 100, 100};
    scene.lights.push_back(lamp);
    const Rendered lit = renderScene(scene, settings);
    EXPECT_EQ(dark.film.rgba, lit.film.rgba);
    EXPECT_GT(pixel(dark.film, 12, 12, 0), 0.5f * kAlbedo) << "it is not black";
}

} // namespace
} // namespace pointrt::test

// SPDX-License-Identifier: Apache-2.0
// Pictures of Gaussians equal brute force in double precision: seen directly and in a mirror, before and behind
// surfaces, with what they let pass of a lamp's light.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <list>
#include <numbers>
#include <string>
#include <utility>

#include "tests/gaussians/nasty_gaussians.h"
#include "tests/gaussians/srgb.h"
#include "tests/trace/gaussian_file.h"
#include "tests/trace/gaussian_picture.h"
#include "tests/trace/render_helper.h"

namespace pointrt::test {
namespace {

SceneDescription sceneOf(const std::string& path) {
    SceneDescription scene;
    scene.instances.push_back({path, {}, {}, {}});
    return scene;
}

/// Decibels of a capture's picture against brute force.
double psnrOf(const Rendered& rendered, const RenderSettings& settings, const OracleScene& scene) {
    return psnrAgainst(rendered, settings,
                       [&](Vec3 direction) { return lightOf(compositeAlong(scene, rendered.camera.eye, direction)); });
}

double psnrOf(const Rendered& rendered, const RenderSettings& settings, const GaussianFile& file) {
    return psnrOf(rendered, settings, file.scene);
}

class GaussianKinds : public testing::TestWithParam<std::string> {};

TEST_P(GaussianKinds, EqualBruteForce) {
    const GaussianFile file(makeGaussians(GetParam(), 400));
    for (const Vec3 eye : {Vec3{0.3, 0.2, 4}, Vec3{-2, 1.5, -1}, Vec3{0, 0, 0.1}}) {
        const RenderSettings settings = lookingFrom(eye, {0, 0, 0});
        for (const KernelForm form : {KernelForm::kWavefront, KernelForm::kMegakernel}) {
            const Rendered rendered = renderScene(sceneOf(file.path), settings, {form});
            EXPECT_EQ(rendered.rays.cut, 0u);
            EXPECT_GT(psnrOf(rendered, settings, file), 60) << "from " << eye.x << ", " << eye.y << ", " << eye.z;
        }
    }
}

INSTANTIATE_TEST_SUITE_P(Each, GaussianKinds, testing::ValuesIn(gaussianKinds()),
                         [](const auto& kind) { return kind.param; });

// Not only Gaussians that files hold: opacities near 1/255, and Gaussians of all sizes seen from among them.
TEST(Gaussians, FilesShowWhatTheirInputHas) {
    const auto psnrFrom = [](Vec3 eye, const std::vector<OracleGaussian>& input) {
        const GaussianFile file(input);
        const RenderSettings settings = lookingFrom(eye, {0, 0, 0}, 24);
        return psnrOf(renderScene(sceneOf(file.path), settings), settings, oracleScene(input));
    };
    EXPECT_GT(psnrFrom({0.3, 0.2, 4}, makeGaussians("layers", 3000)), 45);
    EXPECT_GT(psnrFrom({0, 0, 0.1}, makeGaussians("mixed", 12000)), 45);
}

// More Gaussians than a loop of lavapipe's can test: the next loop continues after the last Gaussian added.
TEST(Gaussians, RaysThroughThousandsGoOnInFurtherRuns) {
    const GaussianFile file(makeGaussians("inside", 8000));
    const RenderSettings settings = lookingFrom({0, 0, 0}, {0, 1, 0.2}, 8);
    const Rendered rendered = renderScene(sceneOf(file.path), settings);
    EXPECT_EQ(rendered.rays.cut, 0u);
    EXPECT_GT(psnrOf(rendered, settings, file),
              55); // where thousands are faint, floats end rays one Gaussian sooner or later
}

TEST(Gaussians, RaysThroughThousandsOfFaintLayersGoOnUntilNothingPasses) {
    const GaussianFile file(makeGaussians("layers", 3000));
    const RenderSettings settings = lookingFrom({0.3, 0.2, 4}, {0, 0, 0}, 16);
    const Rendered rendered = renderScene(sceneOf(file.path), settings);
    EXPECT_EQ(rendered.rays.cut, 0u);
    EXPECT_GT(psnrOf(rendered, settings, file), 80);
}

// A sky that is a thousand times as large as the scene would leave a thin Gaussian half of its deviation.
TEST(Gaussians, GiantsLeaveFloatsToTheOthers) {
    const GaussianFile file(makeGaussians("mixed", 4000));
    const RenderSettings settings = lookingFrom({0, 0, 0.1}, {0, 0, 0});
    const Rendered rendered = renderScene(sceneOf(file.path), settings);
    EXPECT_GT(psnrOf(rendered, settings, file), 70);
}

// Training leaves some Gaussians that have blown up, and some that have collapsed.
TEST(Gaussians, OfAnySizeAreKept) {
    for (const double sigma : {1e-30, 1e-19, 1e19, 1e30}) {
        const GaussianFile file(
            {roundGaussian({0, 0, 0}, 0.3, 0.5, {1, 0.2, 0.1}), roundGaussian({0, 0, -1}, sigma, 0.5, {0.1, 0.2, 1})});
        const RenderSettings settings = lookingFrom({0.3, 0.2, 4}, {0, 0, 0});
        const Rendered rendered = renderScene(sceneOf(file.path), settings);
        EXPECT_GT(psnrAgainst(rendered, settings,
                              [&](Vec3 direction) {
                                  return lightOf(compositeAlong(file.scene, rendered.camera.eye, direction));
                              }),
                  60)
            << sigma;
        EXPECT_GT(pixel(rendered.film, 0, 0, 2), sigma > 1 ? 0.1 : -1); // in front of the other one everywhere
    }
}

TEST(Gaussians, AreSeenInMirrors) {
    const GaussianFile file(makeGaussians("random", 300));
    SceneDescription scene = sceneOf(file.path);
    scene.materials.resize(1);
    scene.materials[0].kind = MaterialKind::kMirror;
    scene.materials[0].color = {1, 1, 1};
    scene.shapes = {screenAt(5, 0)};
    RenderSettings settings = lookingFrom({0, 0, 3}, {0, 0, 5});
    settings.integrator = Integrator::kWhitted;
    for (const KernelForm form : {KernelForm::kWavefront, KernelForm::kMegakernel}) {
        const Rendered rendered = renderScene(scene, settings, {form});
        EXPECT_GT(psnrAgainst(rendered, settings,
                              [&](Vec3 direction) {
                                  const Vec3 eye = rendered.camera.eye;
                                  return lightOf(compositeAlong(file.scene, {eye.x, eye.y, 10 - eye.z},
                                                                {direction.x, direction.y, -direction.z}));
                              }),
                  60);
    }
}

TEST(Gaussians, HideSurfacesAsFarAsTheyAreOpaque) {
    const GaussianFile file(makeGaussians("random", 300));
    SceneDescription scene = sceneOf(file.path);
    scene.materials.resize(1);
    scene.materials[0].color = {0, 0, 0};
    scene.materials[0].emission = {0.2f, 0.5f, 0.7f};
    const double plane = 0.1; // the plane is among them
    scene.shapes = {screenAt(plane, 0)};
    const RenderSettings settings = lookingFrom({0, 0, 4}, {0, 0, 0});
    const Rendered rendered = renderScene(scene, settings);
    EXPECT_GT(psnrAgainst(rendered, settings,
                          [&](Vec3 direction) {
                              const Vec3 eye = rendered.camera.eye;
                              const OracleComposite before =
                                  compositeAlong(file.scene, eye, direction, (plane - eye.z) / direction.z);
                              Color light = lightBefore(before);
                              for (std::size_t c = 0; c < 3; ++c)
                                  light[c] += static_cast<float>(before.transmittance) * scene.materials[0].emission[c];
                              return light;
                          }),
              60);
}

/// Light of the floor under a Gaussian below a lamp; opacity 0: nothing is there.
double floorLight(double opacity, KernelForm form) {
    const GaussianFile file({roundGaussian({0, 1, 0}, 0.2, std::max(opacity, 0.5), {1, 1, 1})});
    SceneDescription scene;
    if (opacity > 0) scene = sceneOf(file.path);
    scene.materials.resize(1);
    scene.shapes = {{ShapeKind::kPlane, {0, 0, 0}, {1, 0, 0}, {0, 0, -1}, {0, 1, 0}, 0}};
    scene.lights = {PointLight{{0, 3, 0}, {10, 10, 10}}};
    RenderSettings settings = lookingFrom({3, 0.5, 0}, {0, 0, 0}, 8); // all pixels see the same
    settings.spp = 16;
    settings.camera.fov_deg = 0.1;
    const Rendered rendered = renderScene(scene, settings, {form});
    double sum = 0;
    for (std::uint32_t i = 0; i < 64; ++i) sum += pixel(rendered.film, i % 8, i / 8, 0);
    return sum / 64;
}

TEST(Gaussians, ShadowsAreAsDarkAsTheyAreOpaque) {
    for (const KernelForm form : {KernelForm::kWavefront, KernelForm::kMegakernel}) {
        const double lit = floorLight(0, form);
        EXPECT_GT(lit, 0.01);
        // shadow rays pass or not at random: with a deviation of 0.5, 1 / 32 of it is 0.016
        EXPECT_NEAR(floorLight(0.6, form) / lit, 0.4, 0.06);
    }
}

/// The light of a flat Gaussian under a lamp and an even sky.
double caughtLight(bool has_ball, Integrator integrator, KernelForm form) {
    OracleGaussian flat = roundGaussian({0, 0, 0}, 2, 0.99, {0.8, 0.8, 0.8});
    flat.deviation[1] = 0.01;
    const GaussianFile file({flat});
    SceneDescription scene = sceneOf(file.path);
    scene.materials.resize(1);
    const double above = has_ball ? 1 : 9; // the lamp is between
    scene.shapes = {{ShapeKind::kSphere, {0, above, 0}, {0.3, 0, 0}, {0, 0.3, 0}, {0, 0, 0.3}, 0}};
    scene.lights = {PointLight{{0, 3, 0}, {10, 10, 10}}};
    scene.sky = evenSky(0.2f);
    RenderSettings settings = lookingFrom({3, 1, 0}, {0, 0, 0}, 1);
    settings.background.reset();
    settings.camera.fov_deg = 0.1;
    settings.integrator = integrator;
    return pixel(renderScene(scene, settings, {form}).film, 0, 0, 0);
}

TEST(Gaussians, CatchShadows) {
    const double from_lamp = 10.0 / 9, from_sky = 0.2 * std::numbers::pi; // irradiance, W/m^2
    for (const KernelForm form : {KernelForm::kWavefront, KernelForm::kMegakernel})
        for (const Integrator integrator : {Integrator::kPhong, Integrator::kPath}) {
            const double lit = caughtLight(false, integrator, form);
            EXPECT_NEAR(lit, linearFromSrgb(0.8), 0.02);
            EXPECT_NEAR(caughtLight(true, integrator, form) / lit, from_sky / (from_sky + from_lamp), 0.02);
        }
}

TEST(Gaussians, AlphaIsTheirOpacity) {
    const GaussianFile file(makeGaussians("random", 300));
    RenderSettings settings = lookingFrom({0.3, 0.2, 4}, {0, 0, 0});
    settings.spp = 1;
    for (const KernelForm form : {KernelForm::kWavefront, KernelForm::kMegakernel}) {
        const Rendered rendered = renderScene(sceneOf(file.path), settings, {form});
        for (std::uint32_t y = 0; y < settings.height; ++y)
            for (std::uint32_t x = 0; x < settings.width; ++x) {
                const OracleComposite truth = compositeAlong(file.scene, rendered.camera.eye,
                                                             centerRayDirection(settings, rendered.camera, x, y));
                ASSERT_NEAR(pixel(rendered.film, x, y, 3), 1 - truth.transmittance, 1e-3) << x << ", " << y;
            }
    }
}

/// What is lit by a lamp, with something in between.
enum class Lit { kGaussian, kSurface };
enum class Between { kNothing, kBall, kFog };
enum class SeenBy { kDirectly, kInMirror, kThroughGlass };

/// Puts a mirror in front of the camera and turns the camera to it, or puts a pane of glass there.
void lookThrough(SeenBy seen, SceneDescription& scene, RenderSettings& settings) {
    if (seen == SeenBy::kDirectly) return;
    const auto material = static_cast<std::uint32_t>(scene.materials.size());
    scene.materials.emplace_back().color = {1, 1, 1};
    scene.materials.back().kind = seen == SeenBy::kInMirror ? MaterialKind::kMirror : MaterialKind::kGlass;
    settings.bounces = 4; // through both faces of the pane
    if (seen == SeenBy::kInMirror) {
        scene.shapes.push_back(screenAt(2, material));
        settings.camera.target = {0, 0, 4}; // where the mirror shows the origin
    } else {
        // across the ray, which it does not shift then
        const Vec3 eye = settings.camera.eye.value(), along = normalize(eye), across = 0.1 * Vec3{-along.y, along.x, 0};
        scene.shapes.push_back({ShapeKind::kBox, 0.5 * eye, 0.05 * along, across, {0, 0, 0.1}, material});
    }
}

/// The light of a grey surface, or of a flat and nearly opaque Gaussian.
double litLight(Lit lit, Between between, Integrator integrator, KernelForm form, SeenBy seen = SeenBy::kDirectly,
                bool caustics = false) {
    OracleGaussian flat = roundGaussian({0, 0, 0}, 0.1, 0.99, {0.8, 0.8, 0.8});
    flat.deviation[1] = 0.001;
    // a fifth of a unit wide; 3 above the lamp if it must not hide anything
    const OracleGaussian fog = roundGaussian({0, between == Between::kFog ? 1.5 : 6, 0}, 0.2, 0.6, {1, 1, 1});
    const GaussianFile file(lit == Lit::kGaussian ? std::vector{flat, fog} : std::vector{fog});
    SceneDescription scene = sceneOf(file.path);
    scene.materials.resize(1);
    const auto albedo = static_cast<float>(linearFromSrgb(0.8));
    scene.materials[0].color = {albedo, albedo, albedo};
    const double ball = between == Between::kBall ? 1.5 : 9;
    scene.shapes = {{ShapeKind::kSphere, {0, ball, 0}, {0.3, 0, 0}, {0, 0.3, 0}, {0, 0, 0.3}, 0}};
    // through glass so small that no reflection shows it, just as none shows the Gaussian
    const double reach = seen == SeenBy::kThroughGlass ? 0.05 : 1;
    const ShapeKind kind = seen == SeenBy::kDirectly ? ShapeKind::kPlane : ShapeKind::kDisc;
    if (lit == Lit::kSurface) scene.shapes.push_back({kind, {0, 0, 0}, {reach, 0, 0}, {0, 0, -reach}, {0, 1, 0}, 0});
    scene.lights = {PointLight{{0, 3, 0}, {10, 10, 10}}};
    RenderSettings settings = lookingFrom({3, 0.5, 0}, {0, 0, 0}, 8); // all pixels see the same
    settings.camera.fov_deg = 0.01;
    settings.spp = 16;
    settings.relight = true;
    settings.caustics = caustics; // only surfaces gather photons
    settings.bounces = 0;
    settings.integrator = integrator;
    lookThrough(seen, scene, settings);
    const Rendered rendered = renderScene(scene, settings, {form});
    double sum = 0;
    for (std::uint32_t i = 0; i < 64; ++i) sum += pixel(rendered.film, i % 8, i / 8, 0);
    return sum / 64;
}

TEST(Gaussians, AreLitAsMatteSurfaces) {
    for (const KernelForm form : {KernelForm::kWavefront, KernelForm::kMegakernel})
        for (const Integrator integrator : {Integrator::kPhong, Integrator::kPath}) {
            const double truth = litLight(Lit::kSurface, Between::kNothing, integrator, form);
            EXPECT_NEAR(truth, linearFromSrgb(0.8) * (10.0 / 9) / std::numbers::pi, 0.001);
            EXPECT_NEAR(litLight(Lit::kGaussian, Between::kNothing, integrator, form) / truth, 0.99, 0.01);
            EXPECT_LT(litLight(Lit::kGaussian, Between::kBall, integrator, form), 0.01);
            // shadow rays pass or not at random, as in ShadowsAreAsDarkAsTheyAreOpaque
            EXPECT_NEAR(litLight(Lit::kGaussian, Between::kFog, integrator, form) / truth, 0.4, 0.06);
        }
}

TEST(Gaussians, AreLitInMirrorsAndThroughGlass) {
    for (const auto& [seen, form] : {std::pair{SeenBy::kInMirror, KernelForm::kMegakernel},
                                     std::pair{SeenBy::kThroughGlass, KernelForm::kWavefront}}) {
        const auto light = [&, seen = seen, form = form](Lit lit, Between between) {
            return litLight(lit, between, Integrator::kWhitted, form, seen);
        };
        const double truth = light(Lit::kSurface, Between::kNothing);
        EXPECT_GT(truth, 0.1);
        EXPECT_NEAR(light(Lit::kGaussian, Between::kNothing) / truth, 0.99, 0.01);
        EXPECT_LT(light(Lit::kGaussian, Between::kBall), 0.01);
    }
}

// The size of photon discs depends on the extent of the scan, which a single Gaussian does not have.
TEST(Gaussians, OneAloneLeavesCausticsAsTheyAre) {
    const auto light = [](bool caustics) {
        return litLight(Lit::kSurface, Between::kNothing, Integrator::kWhitted, KernelForm::kWavefront,
                        SeenBy::kInMirror, caustics);
    };
    // the mirror shows the lamp, 3 above the disc, 5 away from it
    EXPECT_NEAR(light(true) / light(false), 1 + std::pow(3.0 / 5, 3), 0.05);
}

Color colorAt(const Rendered& rendered, std::uint32_t x, std::uint32_t y) {
    return {pixel(rendered.film, x, y, 0), pixel(rendered.film, x, y, 1), pixel(rendered.film, x, y, 2)};
}

/// What an integrator without lights shows at a distance of 3 from the eye.
struct PropertyView {
    Color flat, wall, nothing; ///< of a thin Gaussian in the middle, a quad at the right edge, and the background
};

PropertyView propertyView(Integrator integrator, bool several, KernelForm form) {
    OracleGaussian flat = roundGaussian({0, 0, 1}, 0.2, 0.9, {0.8, 0.2, 0.3});
    flat.deviation[2] = 0.001;
    const OracleGaussian behind = roundGaussian({0, 0, -2}, 0.1, 0.9, {0, 1, 0});
    std::vector<std::vector<OracleGaussian>> captures{{flat, behind}};
    if (several) captures = {{flat}, {behind}};
    std::list<GaussianFile> files;
    SceneDescription scene;
    for (const std::vector<OracleGaussian>& each : captures)
        scene.instances.push_back({files.emplace_back(each).path, {}, {}, {}});
    scene.materials.resize(1);
    scene.shapes = {{ShapeKind::kQuad, {6, 0, 1}, {5, 0, 0}, {0, 0.5, 0}, {0, 0, 1}, 0}};
    RenderSettings settings = lookingFrom({0, 0, 4}, {0, 0, 0});
    settings.integrator = integrator;
    settings.background = Background{{128, 128, 128}}; // must neither be shown nor subtracted
    const Rendered rendered = renderScene(scene, settings, {form});
    return {colorAt(rendered, kGaussianPixels / 2, kGaussianPixels / 2),
            colorAt(rendered, kGaussianPixels - 1, kGaussianPixels / 2), colorAt(rendered, 0, 0)};
}

TEST(Gaussians, ShowNormalAndDepthWhereHalfOfTheLightIsHidden) {
    for (const bool several : {false, true})
        for (const KernelForm form : {KernelForm::kWavefront, KernelForm::kMegakernel}) {
            const PropertyView normal = propertyView(Integrator::kNormal, several, form);
            const PropertyView depth = propertyView(Integrator::kDepth, several, form);
            // the edge of the picture, 3 in front of the eye, is 3 tan(20 degrees) from the middle
            const double to_wall = std::hypot(3, 3 * std::tan(std::numbers::pi / 9) * (1 - 1.0 / kGaussianPixels));
            for (std::size_t c = 0; c < 3; ++c) {
                EXPECT_NEAR(normal.flat[c], normal.wall[c], 0.01);
                EXPECT_NEAR((1 - depth.flat[c]) / (1 - depth.wall[c]), 3 / to_wall, 0.002);
                EXPECT_EQ(normal.nothing[c], 0);
                EXPECT_EQ(depth.nothing[c], 0);
            }
            EXPECT_NEAR(normal.wall[2], 1, 1e-3);
        }
}

TEST(Gaussians, FirstHitsAreWhereHalfOfTheLightIsHidden) {
    const GaussianFile file(makeGaussians("random", 300));
    const RenderSettings settings = lookingFrom({0.3, 0.2, 4}, {0, 0, 0});
    const Rendered rendered = renderScene(sceneOf(file.path), settings);
    std::size_t others = 0, hits = 0;
    for (std::uint32_t y = 0; y < settings.height; ++y)
        for (std::uint32_t x = 0; x < settings.width; ++x) {
            const OracleComposite truth =
                compositeAlong(file.scene, rendered.camera.eye, centerRayDirection(settings, rendered.camera, x, y));
            const std::size_t i = std::size_t{y} * settings.width + x;
            const bool is_hit = std::isfinite(truth.depth);
            hits += is_hit;
            if (is_hit != std::isfinite(rendered.film.depth[i]))
                ++others;
            else if (is_hit)
                others += std::abs(rendered.film.depth[i] - truth.depth) > 1e-4;
        }
    EXPECT_GT(hits, 100u);
    EXPECT_LE(others, hits / 100); // where rounding moves a ray across the half
}

} // namespace
} // namespace pointrt::test

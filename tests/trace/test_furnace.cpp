// SPDX-License-Identifier: Apache-2.0
// Conservation of energy: the radiance of evenly lit white objects is known in advance.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <numbers>
#include <string>
#include <vector>

#include "tests/trace/render_helper.h"

namespace pointrt::test {

namespace {

constexpr std::size_t kFurnaceSplats = 20000;

struct Body {
    const char* name;
    MaterialDescription material;
};

MaterialDescription white(MaterialKind kind, float roughness = 0) {
    MaterialDescription material;
    material.kind = kind;
    material.color = {1, 1, 1};
    material.roughness = roughness;
    return material;
}

std::vector<Body> whiteBodies() {
    Body half_mirror{"matte, mirror share 0.3", white(MaterialKind::kMatte)};
    half_mirror.material.mirror_share = 0.3f;
    Body pane{"thin glass", white(MaterialKind::kGlass)};
    pane.material.thin = true;
    return {{"matte", white(MaterialKind::kMatte)},
            {"metal 0.05", white(MaterialKind::kMetal, 0.05f)},
            {"metal 0.3", white(MaterialKind::kMetal, 0.3f)},
            {"metal 0.6", white(MaterialKind::kMetal, 0.6f)},
            {"metal 1.0", white(MaterialKind::kMetal, 1.0f)},
            {"plastic 0.1", white(MaterialKind::kPlastic, 0.1f)},
            {"plastic 0.5", white(MaterialKind::kPlastic, 0.5f)},
            {"mirror", white(MaterialKind::kMirror)},
            {"glass", white(MaterialKind::kGlass)},
            half_mirror,
            pane};
}

/// One body for each kind of material: most of the time here is spent building programs, and bodies that differ only in
/// roughness share a program.
std::vector<Body> oneOfEachKind() {
    std::vector<Body> bodies;
    for (Body& body : whiteBodies()) {
        const bool again = !bodies.empty() && bodies.back().material.kind == body.material.kind &&
                           bodies.back().material.thin == body.material.thin;
        if (!again) bodies.push_back(std::move(body));
    }
    return bodies;
}

/// Mean, lowest and highest value of one channel over the pixels that the body covers completely.
struct Reading {
    double mean = 0, low = 1e30, high = -1e30;
    std::size_t pixels = 0;
};

Reading readCovered(const Film& film) {
    Reading reading;
    for (std::size_t i = 0; i < film.samples.size(); ++i) {
        if (film.rgba[4 * i + 3] < 0.9999f) continue;
        const double value = film.rgba[4 * i + 1];
        reading.mean += value;
        reading.low = std::min(reading.low, value);
        reading.high = std::max(reading.high, value);
        ++reading.pixels;
    }
    reading.mean /= static_cast<double>(reading.pixels);
    return reading;
}

Reading report(const char* what, const char* body, const char* surface, const Film& film) {
    const Reading r = readCovered(film);
    std::printf("%-24s %-24s %-8s mean %.5f, %.4f to %.4f over %zu pixels\n", what, body, surface, r.mean, r.low,
                r.high, r.pixels);
    return r;
}

RenderSettings seenFrom(Vec3 eye, Vec3 target, double fov_deg, Integrator integrator) {
    RenderSettings settings = square(32);
    settings.camera.eye = eye;
    settings.camera.target = target;
    settings.camera.fov_deg = fov_deg;
    settings.integrator = integrator;
    settings.bounces = 32;
    return settings;
}

/// Views inside the closed sphere: from its centre, and from near its wall.
std::vector<RenderSettings> insideViews(Integrator integrator) {
    return {seenFrom({0, 0, 0}, {0, 0, -1}, 90, integrator), seenFrom({0.7, 0.1, 0.2}, {0, -1, 0.1}, 90, integrator)};
}

/// A unit sphere from outside; it fills the middle half of the picture.
RenderSettings outsideView(Integrator integrator) { return seenFrom({0, 1, 4}, {0, 0, 0}, 40, integrator); }

/// The scene with splats and the one with the analytic sphere.
struct Surface {
    const char* name;
    SceneDescription scene;
};
std::vector<Surface> bothSurfaces(const SphereFile& file, const MaterialDescription& material) {
    return {{"splats", splatBody(file.path, material)}, {"shape", analyticSphere(material)}};
}

TEST(Furnace, GlowingGreySphereIsWhiteFromWithin) {
    // albedo and emission 0.5: 0.5 + 0.5 (0.5 + 0.5 (...)) = 1
    const SphereFile file(kFurnaceSplats);
    MaterialDescription grey;
    grey.color = grey.emission = {0.5f, 0.5f, 0.5f};
    for (const Surface& surface : bothSurfaces(file, grey))
        for (RenderSettings settings : insideViews(Integrator::kPath)) {
            settings.spp = 64;
            const Rendered rendered = renderScene(surface.scene, settings);
            const Reading r = report("glowing inside", "matte 0.5", surface.name, rendered.film);
            EXPECT_EQ(r.pixels, 32u * 32u);
            EXPECT_NEAR(r.mean, 1, 0.003);
            EXPECT_GT(r.low, 0.9);
        }
}

TEST(Furnace, GreySphereLitFromItsCentreMatchesTheFormula) {
    // E = I / R^2 everywhere: one reflection gives albedo E / pi, infinitely many albedo / (1 - albedo) E / pi = 1
    const SphereFile file(kFurnaceSplats);
    MaterialDescription grey;
    grey.color = {0.5f, 0.5f, 0.5f};
    const auto intensity = static_cast<float>(std::numbers::pi);
    for (Surface& surface : bothSurfaces(file, grey)) {
        surface.scene.lights = {PointLight{{0, 0, 0}, {intensity, intensity, intensity}}};
        for (const auto& [integrator, expected] :
             {std::pair{Integrator::kPhong, 0.5}, {Integrator::kWhitted, 0.5}, {Integrator::kPath, 1.0}}) {
            RenderSettings settings = insideViews(integrator)[1];
            settings.spp = integrator == Integrator::kPath ? 64 : 4;
            const Rendered rendered = renderScene(surface.scene, settings);
            const Reading r =
                report("lit from its centre", expected < 1 ? "classic" : "path", surface.name, rendered.film);
            EXPECT_EQ(r.pixels, 32u * 32u);
            EXPECT_NEAR(r.mean, expected, 0.01 * expected);
        }
    }
}

TEST(Furnace, WhiteBodiesVanishInAWhiteSky) {
    const SphereFile file(kFurnaceSplats);
    for (const Body& body : whiteBodies())
        for (Surface& surface : bothSurfaces(file, body.material)) {
            surface.scene.sky = evenSky(1);
            RenderSettings settings = outsideView(Integrator::kPath);
            settings.spp = 64;
            const Reading r =
                report("white sky, path", body.name, surface.name, renderScene(surface.scene, settings).film);
            EXPECT_GT(r.pixels, 200u);
            EXPECT_NEAR(r.mean, 1, 0.01) << body.name << ", " << surface.name;
        }
}

TEST(Furnace, WhiteBodiesVanishInAWhitePicture) {
    const SphereFile file(kFurnaceSplats);
    const std::string picture = writeSky("white.exr", 16, [](Vec3) { return Color{1, 1, 1}; });
    for (const Body& body : oneOfEachKind())
        for (Surface& surface : bothSurfaces(file, body.material)) {
            surface.scene.sky->image = picture;
            RenderSettings settings = outsideView(Integrator::kPath);
            settings.spp = 32;
            const Reading r =
                report("white picture, path", body.name, surface.name, renderScene(surface.scene, settings).film);
            EXPECT_NEAR(r.mean, 1, 0.01) << body.name << ", " << surface.name;
        }
    std::remove(picture.c_str());
}

TEST(Furnace, ClassicIntegratorsKeepAllLight) {
    // with the whole sky as ambient light every kind reflects all of it; mirrors and glass need no ambient light
    const SphereFile file(kFurnaceSplats);
    for (const Body& body : oneOfEachKind())
        for (Surface& surface : bothSurfaces(file, body.material))
            for (const Integrator integrator : {Integrator::kPhong, Integrator::kWhitted}) {
                const bool specular =
                    body.material.kind == MaterialKind::kMirror || body.material.kind == MaterialKind::kGlass;
                surface.scene.sky = evenSky(1, specular ? 0 : 1);
                RenderSettings settings = outsideView(integrator);
                settings.spp = 4;
                const Reading r = report(integrator == Integrator::kPhong ? "white sky, phong" : "white sky, whitted",
                                         body.name, surface.name, renderScene(surface.scene, settings).film);
                EXPECT_NEAR(r.mean, 1, 0.01) << body.name << ", " << surface.name;
            }
}

} // namespace

} // namespace pointrt::test

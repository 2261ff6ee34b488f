// SPDX-License-Identifier: Apache-2.0
// Shadows, mirrors and ray counts with known answers.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstdio>
#include <numbers>

#include "tests/support/splat_scenes.h"
#include "tests/trace/reference.h"
#include "tests/trace/render_helper.h"

namespace pointrt::test {

namespace {

Vec3 hitPosition(const Rendered& rendered, std::uint32_t x, std::uint32_t y) {
    const std::size_t i = std::size_t{y} * rendered.film.width + x;
    RenderSettings settings = square(rendered.film.width);
    return rendered.camera.eye + rendered.film.depth[i] * centerRayDirection(settings, rendered.camera, x, y);
}

TEST(Light, MirrorShowsTheWallItFaces) {
    // a mirror seen from the left at 45 degrees faces a red wall on the right; what lies behind the mirror is green
    Splats mirror = squareSplats(60, Vec3f(0, 0, 0), Vec3f(1, 0, 0), Vec3f(0, 1, 0), 1.2f);
    Splats red = squareSplats(80, Vec3f(3, 0, 3), Vec3f(0, 0, 2), Vec3f(0, 2, 0), 1.2f);
    Splats green = squareSplats(60, Vec3f(0, 0, -1), Vec3f(2, 0, 0), Vec3f(0, 2, 0), 1.2f);
    paint(mirror, {255, 255, 255});
    paint(red, {255, 0, 0});
    paint(green, {0, 255, 0});
    std::vector<std::uint8_t> material(mirror.positions.size(), 1);
    material.resize(material.size() + red.positions.size() + green.positions.size(), 0);
    BuildOptions options;
    options.materials = {matteRow(1, 1, 1), matteRow(1, 1, 1, 1.0f)};
    const std::string path = temporaryPath("mirror.pro");
    writeScene(path, joinSplats(joinSplats(mirror, red), green), options, material);

    RenderSettings settings = square(64);
    settings.camera.eye = Vec3{-3, 0, 3};
    settings.camera.target = Vec3{0, 0, 0};
    settings.camera.fov_deg = 12; // only the mirror's middle
    settings.shadows = false;
    settings.bounces = 1;
    const Rendered one_bounce = renderFile(path, settings);
    settings.bounces = 0;
    const Rendered no_bounce = renderFile(path, settings);
    std::remove(path.c_str());
    EXPECT_EQ(one_bounce.rays.primary, 64u * 64u);
    EXPECT_EQ(one_bounce.rays.secondary, 64u * 64u);
    EXPECT_EQ(no_bounce.rays.secondary, 0u);
    // the wall's own answer: Lambert under the lights plus the ambient term, at the mirrored point
    for (const auto [x, y] : {std::array{32u, 32u}, std::array{20u, 40u}, std::array{45u, 15u}}) {
        const Vec3 at = hitPosition(one_bounce, x, y), d = normalize(at - one_bounce.camera.eye);
        const Vec3 r{d.x, d.y, -d.z}; // mirrored in the plane z = 0
        const double t = (3.0 - at.x) / r.x;
        const Vec3 wall = at + t * r, n{-1, 0, 0};
        double light = 0;
        for (const LightDescription& each : one_bounce.scene.lights) {
            const auto& lamp = std::get<PointLight>(each);
            const Vec3 to = lamp.position - wall;
            const double cosine = dot(n, to) / length(to);
            light += std::max(0.0, cosine) * double{lamp.intensity[0]} / std::numbers::pi / dot(to, to);
        }
        EXPECT_GT(light, 0.02);
        const double red_seen = pixel(one_bounce.film, x, y, 0), green_seen = pixel(one_bounce.film, x, y, 1);
        const SkyDescription sky;
        const double ambient = sky.ambient * sky.horizon[0]; // the wall is upright
        EXPECT_NEAR(red_seen, light + ambient, 0.02 * (light + ambient));
        EXPECT_LT(green_seen, 1e-3);
    }
}

TEST(Light, ShadowsFallWhereBruteForceSaysSo) {
    // a small square floats above a large one; one light
    Splats splats = joinSplats(squareSplats(120, Vec3f(0, 0, 0), Vec3f(0, 0, 2), Vec3f(2, 0, 0), 1.2f),
                               squareSplats(30, Vec3f(0.3f, 0.7f, -0.2f), Vec3f(0, 0, 0.5f), Vec3f(0.5f, 0, 0), 1.2f));
    const std::string path = temporaryPath("shadow.pro");
    writeScene(path, splats, {});
    RenderSettings settings = square(96);
    settings.camera.eye = Vec3{0.5, 4, 5};
    settings.lights = 1;
    const Rendered lit = [&] {
        RenderSettings open = settings;
        open.shadows = false;
        return renderFile(path, open);
    }();
    const Rendered rendered = renderFile(path, settings);
    const Reference scene = loadReference(path);
    std::remove(path.c_str());
    const Vec3 lamp = std::get<PointLight>(rendered.scene.lights[0]).position;
    std::size_t checked = 0, dark = 0, wrong = 0;
    for (std::uint32_t y = 0; y < 96; ++y)
        for (std::uint32_t x = 0; x < 96; ++x) {
            if (!std::isfinite(rendered.film.depth[96 * y + x])) continue;
            const bool shadowed = pixel(rendered.film, x, y, 0) < 0.98f * pixel(lit.film, x, y, 0);
            const Vec3 at = hitPosition(rendered, x, y), to = lamp - at;
            const Vec3 direction = normalize(to), start = at + 0.03 * direction;
            const bool expected = firstDisc(scene, start, direction, length(to)).has_value();
            ++checked;
            dark += expected;
            wrong += expected != shadowed;
        }
    std::printf("%zu pixels, %zu in shadow, %zu wrong\n", checked, dark, wrong);
    EXPECT_GT(dark, 150u);
    EXPECT_LE(wrong, checked / 400); // the shadow's edge runs through pixels
    EXPECT_GT(rendered.rays.shadow, checked / 2);
}

TEST(Light, NoAcneOnASphere) {
    // a convex body shades none of its own lit points
    const std::string path = temporaryPath("acne.pro");
    BuildOptions options;
    options.prune = true;
    writeScene(path, sphereSplats(20000, Vec3f(0, 0, 0), 1.0f), options);
    RenderSettings settings = square(256);
    settings.lights = 2;
    const Rendered with = renderFile(path, settings);
    settings.shadows = false;
    const Rendered without = renderFile(path, settings);
    std::remove(path.c_str());
    std::size_t lit = 0, acne = 0;
    for (std::size_t i = 0; i < with.film.depth.size(); ++i) {
        const Vec3 at = hitPosition(with, static_cast<std::uint32_t>(i % 256), static_cast<std::uint32_t>(i / 256));
        if (!std::isfinite(with.film.depth[i])) continue;
        if (dot(at, normalize(with.camera.eye - at)) < 0.1) continue; // at the silhouette discs are seen from behind
        ++lit;
        acne += with.film.rgba[4 * i] < 0.999f * without.film.rgba[4 * i] - 1e-4f;
    }
    std::printf("%zu pixels, %zu with acne\n", lit, acne);
    EXPECT_GT(lit, 10000u);
    EXPECT_EQ(acne, 0u);
}

TEST(Light, MirrorRoomCountsEveryBounce) {
    // in a closed mirror room no ray ever leaves: each bounce traces what the matte body has not stopped
    const std::string path = temporaryPath("room.pro");
    writeScene(path, sphereSplats(5000, Vec3f(0, 0, 0), 1.0f), {});
    RenderSettings settings = square(64);
    settings.room = Room::kMirror;
    settings.bounces = 12;
    const Rendered rendered = renderFile(path, settings);
    std::remove(path.c_str());
    EXPECT_EQ(rendered.rays.primary, 64u * 64u);
    EXPECT_GT(rendered.rays.secondary, 4u * 64u * 64u);
    EXPECT_LE(rendered.rays.secondary, 12u * 64u * 64u);
    for (std::size_t i = 0; i < rendered.film.depth.size(); ++i) {
        ASSERT_TRUE(std::isfinite(rendered.film.depth[i])); // the room is hit where the body is not
        ASSERT_TRUE(std::isfinite(rendered.film.rgba[4 * i]));
    }
}

TEST(Light, SixtyFourBouncesAreNotCutShort) {
    // two facing mirrors: every bounce of every ray is traced, though lavapipe ends loops after 65535 turns
    Splats a = squareSplats(40, Vec3f(0, 0, 0), Vec3f(1, 0, 0), Vec3f(0, 1, 0), 1.2f);
    Splats b = squareSplats(40, Vec3f(0, 0, 1), Vec3f(0, 1, 0), Vec3f(1, 0, 0), 1.2f);
    BuildOptions options;
    options.materials = {matteRow(1, 1, 1, 1.0f)};
    const std::string path = temporaryPath("facing.pro");
    writeScene(path, joinSplats(a, b), options);
    RenderSettings settings = square(16);
    settings.camera.eye = Vec3{0, 0, 0.5};
    settings.camera.target = Vec3{0, 0, 0};
    settings.camera.fov_deg = 0.5;
    settings.bounces = 64;
    const Rendered rendered = renderFile(path, settings);
    std::remove(path.c_str());
    EXPECT_EQ(rendered.rays.secondary, 64u * 16u * 16u);
}

TEST(Light, BandsJoinWithoutASeam) {
    // larger than one band of pixels: the same picture as a crop rendered alone would show, no row missing or doubled
    const std::string path = temporaryPath("bands.pro");
    writeScene(path, sphereSplats(3000, Vec3f(0, 0, 0), 1.0f), {});
    RenderSettings settings = square(1200);
    settings.shadows = false;
    const Rendered large = renderFile(path, settings);
    settings.width = settings.height = 400;
    const Rendered small = renderFile(path, settings);
    std::remove(path.c_str());
    for (std::uint32_t y = 0; y < 400; y += 7)
        for (std::uint32_t x = 0; x < 400; x += 7) { // pixel centres coincide
            const float a = large.film.depth[std::size_t{3 * y + 1} * 1200 + 3 * x + 1],
                        b = small.film.depth[std::size_t{y} * 400 + x];
            if (std::isfinite(a) && std::isfinite(b)) {
                ASSERT_NEAR(a, b, 1e-4);
            } else {
                ASSERT_EQ(std::isfinite(a), std::isfinite(b));
            }
        }
}

/// The sky's green averaged over the hemisphere around +Z by the cosine, up being +Y.
double skyOverHemisphere() {
    const SkyDescription sky;
    double sum = 0;
    const int steps = 400;
    for (int i = 0; i < steps; ++i)
        for (int j = 0; j < steps; ++j) {
            const double ring = std::sqrt((i + 0.5) / steps),
                         height = ring * std::sin(6.28318530718 * (j + 0.5) / steps);
            const double share = std::sqrt(std::abs(height)), end = height > 0 ? sky.zenith[1] : sky.ground[1];
            sum += sky.horizon[1] + share * (end - sky.horizon[1]);
        }
    return sum / (steps * steps);
}

TEST(Light, WhiteSphereGivesBackTheWholeSky) {
    // a white convex body is lit by the sky alone: where its normal is +Z it shows the sky's mean over that hemisphere
    const std::string path = temporaryPath("furnace.pro");
    writeScene(path, sphereSplats(20000, Vec3f(0, 0, 0), 1.0f), {});
    RenderSettings settings = square(32);
    settings.spp = 400;
    settings.lights = 0;
    settings.bounces = 8;
    settings.integrator = Integrator::kPath;
    const Rendered rendered = renderFile(path, settings);
    std::remove(path.c_str());
    const double middle = 0.25 * (pixel(rendered.film, 15, 15, 1) + pixel(rendered.film, 16, 15, 1) +
                                  pixel(rendered.film, 15, 16, 1) + pixel(rendered.film, 16, 16, 1));
    EXPECT_NEAR(middle, skyOverHemisphere(), 0.02 * skyOverHemisphere());
}

TEST(Light, WholeCloudInOneLeaf) {
    // no octree at all: the root is the leaf, and its list is longer than any leaf of a real scene
    const std::string path = temporaryPath("root.pro");
    BuildOptions options;
    options.octree.max_depth = 0;
    writeScene(path, sphereSplats(2000, Vec3f(0, 0, 0), 1.0f), options);
    const Rendered one = renderFile(path, square(48));
    writeScene(path, sphereSplats(2000, Vec3f(0, 0, 0), 1.0f), {});
    const Rendered many = renderFile(path, square(48));
    std::remove(path.c_str());
    for (std::size_t i = 0; i < one.film.depth.size(); ++i) {
        ASSERT_EQ(std::isfinite(one.film.depth[i]), std::isfinite(many.film.depth[i])) << i;
        if (std::isfinite(one.film.depth[i])) {
            EXPECT_NEAR(one.film.depth[i], many.film.depth[i], 2e-3);
        }
    }
}

} // namespace

} // namespace pointrt::test

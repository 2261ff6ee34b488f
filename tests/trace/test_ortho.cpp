// SPDX-License-Identifier: Apache-2.0
// Parallel projection, compared with closed forms: the picture of a sphere is a disc of the same radius.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <numbers>
#include <optional>
#include <utility>

#include "tests/support/splat_scenes.h"
#include "tests/trace/render_helper.h"

namespace pointrt::test {

namespace {

constexpr double kHeight = 2.5; // of the window; the sphere's diameter is 2
/// Pixels closer than this to the silhouette are not compared: it consists of rims of discs, which are up to 2e-4 off
/// the sphere.
constexpr double kRim = 2e-3;
constexpr std::size_t kOrthoSplats = 40000;
constexpr double kSplatRadius = 0.025; // a little more than 1.2 times the mean spacing

/// A view with no symmetry: wider than high, from an oblique direction, and rotated about the line of sight.
RenderSettings slantedView(double distance) {
    RenderSettings settings = square(128);
    settings.width = 200;
    settings.camera.target = Vec3{0.3, -0.1, 0.2}; // the sphere is not in the middle
    settings.camera.eye = *settings.camera.target + distance * normalize(Vec3{1, 0.7, 2});
    settings.camera.up = Vec3{0.4, 1, 0};
    settings.camera.ortho_height = kHeight;
    return settings;
}

/// A pixel's centre on the window, in input coordinates.
Vec3 windowPoint(const Rendered& rendered, std::uint32_t x, std::uint32_t y) {
    const double width = rendered.film.width, height = rendered.film.height, pixel = kHeight / height;
    return rendered.camera.eye + pixel * (x + 0.5 - width / 2) * rendered.camera.right +
           pixel * (height / 2 - y - 0.5) * rendered.camera.up;
}

Vec3 three(const std::vector<float>& values, std::size_t i) {
    return {values[3 * i], values[3 * i + 1], values[3 * i + 2]};
}

struct SphereErrors {
    std::size_t hits = 0, wrong_hit = 0;
    double depth = 0, position = 0, normal_deg = 0; ///< largest
};

/// Errors of the first hits of the unit sphere.
SphereErrors compareWithSphere(const Rendered& rendered) {
    const Film& film = rendered.film;
    const Vec3 forward = rendered.camera.forward;
    SphereErrors errors;
    for (std::uint32_t y = 0; y < film.height; ++y)
        for (std::uint32_t x = 0; x < film.width; ++x) {
            const std::size_t i = std::size_t{y} * film.width + x;
            const Vec3 start = windowPoint(rendered, x, y);
            const double across = length(start - dot(start, forward) * forward), from_middle = length(start);
            const bool hit = std::isfinite(film.depth[i]);
            errors.hits += hit;
            if (std::abs(across - 1) < kRim || std::abs(from_middle - 1) < kSplatRadius) continue;
            const std::optional<double> t = meetSphere(start, forward);
            errors.wrong_hit += hit != t.has_value();
            if (!hit || !t || across > 0.99) continue; // rays that graze a disc meet it far from the sphere
            const Vec3 at = start + *t * forward, normal = from_middle < 1 ? -1.0 * at : at;
            errors.depth = std::max(errors.depth, std::abs(film.depth[i] - *t));
            errors.position = std::max(errors.position, length(three(film.position, i) - at));
            errors.normal_deg = std::max(errors.normal_deg, angleBetween(three(film.normal, i), normal));
        }
    std::printf("%zu hits, %zu wrong, depth off by %.2g, position %.2g, normal %.2g degrees\n", errors.hits,
                errors.wrong_hit, errors.depth, errors.position, errors.normal_deg);
    return errors;
}

/// The number of pixels that the unit disc covers.
double discPixels(const Film& film) { return std::numbers::pi * film.height * film.height / (kHeight * kHeight); }

void expectSplatSphere(const SphereErrors& errors) {
    EXPECT_EQ(errors.wrong_hit, 0u);
    // rims of discs are 2e-4 off the sphere, which is 7 times as much along rays at 8 degrees to the surface
    EXPECT_LT(errors.depth, 1.4e-3);
    EXPECT_LT(errors.position, 1.4e-3);
    EXPECT_LT(errors.normal_deg, 0.5); // flat discs would be off by up to 1.2 degrees, at their rims
}

TEST(Ortho, ShowsASphereAsADiscFromAnywhere) {
    const SphereFile sphere(kOrthoSplats);
    for (const double distance : {3.0, 700.0}) {
        const Rendered rendered = renderFile(sphere.path, slantedView(distance));
        const SphereErrors errors = compareWithSphere(rendered);
        expectSplatSphere(errors);
        EXPECT_NEAR(static_cast<double>(errors.hits), discPixels(rendered.film), 30); // of 8235; 320 are on the edge
    }
}

/// A window beyond the sphere's centre: rays that start inside see the far side, the others miss.
TEST(Ortho, ShowsNothingBehindItsWindow) {
    const SphereFile sphere(kOrthoSplats);
    RenderSettings settings = slantedView(1);
    settings.camera.eye = Vec3{-0.3, 0.1, -0.2};
    settings.camera.target = *settings.camera.eye - Vec3{1, 0.7, 2};
    const SphereErrors errors = compareWithSphere(renderFile(sphere.path, settings));
    expectSplatSphere(errors);
    EXPECT_GT(errors.hits, 7000u);
}

TEST(Ortho, ShowsShapesWhereTheyAre) {
    const SphereErrors errors = compareWithSphere(renderScene(analyticSphere({}), slantedView(5)));
    EXPECT_EQ(errors.wrong_hit, 0u);
    EXPECT_LT(errors.depth, 1e-5);
    EXPECT_LT(errors.position, 1e-5);
    EXPECT_LT(errors.normal_deg, 1e-3);
}

/// With samples all over each pixel the covered area is exact to a small part of a pixel.
TEST(Ortho, CoversTheDiscsArea) {
    RenderSettings settings = slantedView(5);
    settings.spp = 64;
    const Rendered rendered = renderScene(analyticSphere({}), settings);
    double covered = 0;
    for (std::size_t i = 3; i < rendered.film.rgba.size(); i += 4) covered += double{rendered.film.rgba[i]};
    EXPECT_NEAR(covered, discPixels(rendered.film), 2);
}

/// Points are lit at their positions: Lambert's law under a nearby lamp.
TEST(Ortho, LightsVisiblePoints) {
    const SphereFile sphere(kOrthoSplats);
    SceneDescription splats = splatBody(sphere.path, {}), shape = analyticSphere({});
    const Vec3 lamp{1, 1.5, 2};
    for (SceneDescription* scene : {&splats, &shape}) {
        scene->materials[0].color = {1, 1, 1};
        scene->lights.push_back(PointLight{lamp, {5, 5, 5}});
        const Rendered rendered = renderScene(*scene, slantedView(4));
        std::size_t lit = 0;
        double worst = 0;
        for (std::uint32_t y = 0; y < rendered.film.height; ++y)
            for (std::uint32_t x = 0; x < rendered.film.width; ++x) {
                const Vec3 start = windowPoint(rendered, x, y), forward = rendered.camera.forward;
                const double along = dot(start, forward), across2 = dot(start, start) - along * along;
                if (across2 > 0.9) continue;
                const Vec3 at = start - (along + std::sqrt(1 - across2)) * forward, to = lamp - at;
                const double cosine = dot(at, to) / length(to);
                if (cosine < 0.1) continue;
                const double expected = 5 * cosine / dot(to, to) / std::numbers::pi;
                worst = std::max(worst, std::abs(double{pixel(rendered.film, x, y, 0)} / expected - 1));
                ++lit;
            }
        EXPECT_GT(lit, 3000u);
        EXPECT_LT(worst, 0.05); // normals of splats are up to a degree off, six degrees from the terminator
    }
}

/// Rays along an axis, many of them in the planes between cells.
TEST(Ortho, LeavesNoHolesAlongAnAxis) {
    const std::string path = temporaryPath("square.pro");
    writeScene(path, squareSplats(64, Vec3f(0, 0, 0), Vec3f(1, 0, 0), Vec3f(0, 1, 0), 1.2f), {});
    for (const auto& [size, z] : {std::pair{128u, 3.0}, std::pair{129u, -3.0}}) {
        RenderSettings settings = square(size);
        settings.camera.eye = Vec3{0, 0, z};
        settings.camera.ortho_height = 2;
        const Rendered rendered = renderFile(path, settings);
        for (const float depth : rendered.film.depth) ASSERT_NEAR(depth, 3, 1e-4);
    }
    std::remove(path.c_str());
}

} // namespace

} // namespace pointrt::test

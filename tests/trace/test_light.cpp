// SPDX-License-Identifier: Apache-2.0
// Shadows, mirrors and ray counts with known answers.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <numbers>
#include <string>

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
    // a mirror seen from the left at 45 degrees faces a red wall on the right; behind the mirror everything is green
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
    // the wall's own colour: Lambert under the lights plus the ambient term, at the mirrored point
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

TEST(Light, ShadowsMatchBruteForce) {
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
    EXPECT_LE(wrong, checked / 400); // the shadow's edge crosses pixels
    EXPECT_GT(rendered.rays.shadow, checked / 2);
}

TEST(Light, NoAcneOnASphere) {
    // a convex body does not shadow its own lit points
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
    // no ray leaves a closed mirror room: each bounce traces all rays that have not hit the matte body
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

TEST(Light, SixtyFourBouncesAreTraced) {
    // two facing mirrors: every bounce of every ray is traced, although lavapipe ends loops after 65535 iterations
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
    // larger than one band: the same picture as a crop rendered alone, without missing or doubled rows
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

/// The cosine-weighted mean of the sky's green over the hemisphere around +Z; +Y is up.
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

TEST(Light, WhiteSphereReflectsTheWholeSky) {
    // only the sky lights a white convex body: where its normal is +Z it has the mean radiance of that hemisphere
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

/// A square floor of splats at y = 0.
struct WhiteFloor {
    WhiteFloor() : path(temporaryPath("floor.pro")) {
        // rays start a quarter of a radius above it, nearer to the lamps: with fine splats that is below the tolerance
        writeScene(path, squareSplats(300, Vec3f(0, 0, 0), Vec3f(0, 0, 2), Vec3f(2, 0, 0), 1.2f), {});
        MaterialDescription grey;
        grey.color = {0.6f, 0.6f, 0.6f};
        scene = splatBody(path, grey);
    }
    ~WhiteFloor() { std::remove(path.c_str()); }
    WhiteFloor(const WhiteFloor&) = delete;
    WhiteFloor& operator=(const WhiteFloor&) = delete;
    std::string path;
    SceneDescription scene;
};

RenderSettings aboveFloor(std::uint32_t spp) {
    RenderSettings settings = square(32);
    settings.camera.eye = Vec3{0, 3, 5};
    settings.camera.target = Vec3{0, 0, 0};
    settings.camera.fov_deg = 20;
    settings.integrator = Integrator::kPath;
    settings.bounces = 6;
    settings.spp = spp;
    return settings;
}

/// Mean red over all pixels, in doubles.
double meanLight(const Film& film) {
    double sum = 0;
    for (std::size_t i = 0; i < film.samples.size(); ++i) sum += film.rgba[4 * i];
    return sum / static_cast<double>(film.samples.size());
}

TEST(Light, LampsMatchEmissiveShapes) {
    // the same shapes as lamps, which next event estimation samples, and as emissive surfaces, which only scattered
    // rays hit; on a glossy floor both strategies have weight
    WhiteFloor floor;
    floor.scene.materials[0].kind = MaterialKind::kPlastic;
    floor.scene.materials[0].roughness = 0.3f;
    MaterialDescription shining;
    shining.color = {0, 0, 0};
    shining.emission = {3, 3, 3};
    floor.scene.materials.push_back(shining);
    const Color radiance{3, 3, 3};
    SceneDescription with_lamps = floor.scene, with_shapes = floor.scene;
    with_lamps.lights = {SphereLight{{-0.8, 1.2, 0}, 0.5, radiance}, DiscLight{{0, 1, 0.8}, {0, -1, 0}, 0.4, radiance},
                         QuadLight{{1, 1.2, 0}, {0.4, 0.3, 0}, {0, 0, 0.6}, radiance}};
    with_shapes.shapes = {{ShapeKind::kSphere, {-0.8, 1.2, 0}, {0.5, 0, 0}, {0, 0.5, 0}, {0, 0, 0.5}, 1},
                          {ShapeKind::kDisc, {0, 1, 0.8}, {0.4, 0, 0}, {0, 0, 0.4}, {0, -1, 0}, 1},
                          {ShapeKind::kQuad, {1, 1.2, 0}, {0.4, 0.3, 0}, {0, 0, 0.6}, normalize({0.18, -0.24, 0}), 1}};
    const double by_lamps = meanLight(renderScene(with_lamps, aboveFloor(256)).film),
                 by_chance = meanLight(renderScene(with_shapes, aboveFloor(1024)).film);
    std::printf("lamps %.5f, emissive shapes %.5f\n", by_lamps, by_chance);
    EXPECT_GT(by_lamps, 0.1);
    EXPECT_NEAR(by_lamps, by_chance, 0.004 * by_chance);
}

TEST(Light, DiscLampGivesItsViewFactor) {
    // below its centre pi L r^2 / (r^2 + d^2), of which the floor reflects 0.6 / pi; both sides of the lamp shine
    for (const Vec3 normal : {Vec3{0, -1, 0}, Vec3{0, 1, 0}})
        for (const Integrator integrator : {Integrator::kPhong, Integrator::kWhitted, Integrator::kPath}) {
            WhiteFloor floor;
            floor.scene.lights = {DiscLight{{0, 1.5, 0}, normal, 0.5, {4, 4, 4}, false}};
            RenderSettings settings = aboveFloor(64);
            settings.integrator = integrator;
            const Film film = renderScene(floor.scene, settings).film;
            double seen = 0, known = 0;
            for (std::size_t i = 0; i < film.samples.size(); ++i) {
                const float* at = film.position.data() + 3 * i;
                if (film.rgba[4 * i + 3] < 1) continue;
                const double aside = std::hypot(at[0], at[2]), sum = aside * aside + 1.5 * 1.5 + 0.25;
                seen += film.rgba[4 * i];
                known += 0.6 * 4 * 0.5 * (1 - (sum - 0.5) / std::sqrt(sum * sum - aside * aside));
            }
            EXPECT_GT(known, 1);
            EXPECT_NEAR(seen / known, 1, 0.01) << static_cast<int>(integrator);
        }
}

TEST(Light, CameraSeesADiscLamp) {
    for (const bool visible : {true, false}) {
        WhiteFloor floor;
        floor.scene.lights = {DiscLight{{0, 1, 0}, {0, 1, 0}, 0.3, {7, 6, 5}, visible}};
        RenderSettings settings = square(33);
        settings.camera.eye = Vec3{0, 3, 0};
        settings.camera.target = Vec3{0, 0, 0};
        settings.camera.up = Vec3{0, 0, -1};
        settings.integrator = Integrator::kPath;
        const Film film = renderScene(floor.scene, settings).film;
        const std::size_t middle = 16 * 33 + 16;
        EXPECT_EQ(std::abs(film.rgba[4 * middle] - 7) < 1e-4, visible);
        EXPECT_EQ(std::abs(film.rgba[4 * middle + 2] - 5) < 1e-4, visible);
    }
}

TEST(Light, SkyImageMatchesTheEvenSky) {
    // next event estimation samples a sky image, but only scattered rays see an even sky
    WhiteFloor floor;
    floor.scene.materials[0].kind = MaterialKind::kPlastic;
    floor.scene.shapes = {{ShapeKind::kSphere, {0, 0.6, 0}, {0.6, 0, 0}, {0, 0.6, 0}, {0, 0, 0.6}, 0}};
    SceneDescription even = floor.scene, picture = floor.scene;
    even.sky = evenSky(0.8f);
    picture.sky->image = writeSky("even.exr", 16, [](Vec3) { return Color{0.8f, 0.8f, 0.8f}; });
    const double by_even = meanLight(renderScene(even, aboveFloor(256)).film),
                 by_picture = meanLight(renderScene(picture, aboveFloor(256)).film);
    std::remove(picture.sky->image.c_str());
    std::printf("even %.5f, picture %.5f\n", by_even, by_picture);
    EXPECT_NEAR(by_picture, by_even, 0.005 * by_even);
}

TEST(Light, LayersAddUpToThePicture) {
    // a lamp over a matte floor with a glass ball: direct, indirect and focused light
    WhiteFloor floor;
    MaterialDescription glass;
    glass.kind = MaterialKind::kGlass;
    glass.color = {1, 1, 1};
    floor.scene.materials.push_back(glass);
    floor.scene.shapes = {{ShapeKind::kSphere, {0, 0.5, 0}, {0.4, 0, 0}, {0, 0.4, 0}, {0, 0, 0.4}, 1}};
    floor.scene.lights = {SphereLight{{0.5, 2.5, 0}, 0.3, {9, 9, 9}}};
    for (const Integrator integrator : {Integrator::kPath, Integrator::kWhitted}) {
        RenderSettings settings = aboveFloor(16);
        settings.integrator = integrator;
        const Film film = renderScene(floor.scene, settings).film;
        double direct = 0, indirect = 0;
        for (std::size_t i = 0; i < film.samples.size(); ++i)
            for (std::size_t c = 0; c < 3; ++c) {
                const float sum = film.direct[3 * i + c] + film.indirect[3 * i + c] + film.caustic[3 * i + c];
                ASSERT_NEAR(film.rgba[4 * i + c], sum, 1e-5f * (1 + sum));
                direct += film.direct[3 * i + c];
                indirect += film.indirect[3 * i + c];
            }
        EXPECT_GT(direct, 1);
        EXPECT_GT(indirect, 1);
    }
}

TEST(Light, HollowIsNotShadowedUnderAGrazingLamp) {
    // a sphere seen from inside, lit from near its wall: all of it sees the lamp
    const SphereFile file(20000);
    MaterialDescription white;
    white.color = {1, 1, 1};
    SceneDescription scene = splatBody(file.path, white);
    const Vec3 lamp{0, 0, -0.8};
    scene.lights = {PointLight{lamp, {1, 1, 1}}};
    RenderSettings settings = square(128);
    settings.camera.eye = Vec3{0, 0, 0.5};
    settings.camera.target = lamp;
    settings.camera.fov_deg = 100;
    const Rendered rendered = renderScene(scene, settings);
    std::size_t dark = 0;
    double worst = 0;
    for (std::uint32_t y = 0; y < 128; ++y)
        for (std::uint32_t x = 0; x < 128; ++x) {
            const Vec3 at = hitPosition(rendered, x, y), to = lamp - at;
            const double expected = -dot(to, normalize(at)) / length(to) / std::numbers::pi / dot(to, to),
                         seen = pixel(rendered.film, x, y, 0);
            dark += seen < 0.5 * expected;
            worst = std::max(worst, std::abs(seen - expected) / expected);
        }
    std::printf("%zu pixels in shadow, worst difference %.2f%%\n", dark, 100 * worst);
    EXPECT_EQ(dark, 0u);
    EXPECT_LT(worst, 0.05);
}

/// The number of pixels that shadows darken on a level sheet seen from above, whose splats deviate by up to a radius.
std::size_t darkenedOnNoisySheet(const Vec3f& u, const Vec3f& v) {
    Splats sheet = squareSplats(100, Vec3f(0, 0, 0), u, v, 1.2f);
    for (std::size_t i = 0; i < sheet.positions.size(); ++i) // heights are evenly distributed, in no order
        sheet.positions[i].y() += sheet.radii[i] * static_cast<float>(std::fmod(0.618034 * double(i * i % 9973), 1.0));
    const std::string path = temporaryPath("sheet.pro");
    writeScene(path, sheet, {});
    MaterialDescription white;
    SceneDescription scene = splatBody(path, white);
    scene.lights = {PointLight{{1.5, 2, 0}, {4, 4, 4}}};
    RenderSettings settings = square(128);
    settings.camera.eye = Vec3{0, 3, 2};
    settings.camera.target = Vec3{0, 0, 0};
    settings.camera.fov_deg = 20;
    const Film with = renderScene(scene, settings).film;
    settings.shadows = false;
    const Film without = renderScene(scene, settings).film;
    std::remove(path.c_str());
    std::size_t dark = 0;
    for (std::size_t i = 0; i < with.samples.size(); ++i) dark += with.rgba[4 * i] < 0.99f * without.rgba[4 * i];
    return dark;
}

TEST(Light, NoisySheetDoesNotShadeItselfOnEitherSide) {
    const std::size_t front = darkenedOnNoisySheet(Vec3f(0, 0, 1), Vec3f(1, 0, 0)),
                      back = darkenedOnNoisySheet(Vec3f(1, 0, 0), Vec3f(0, 0, 1));
    std::printf("in shadow: %zu pixels seen from the front, %zu from behind\n", front, back);
    EXPECT_LE(front, 16u); // a thousandth
    EXPECT_LE(back, 16u);
}

TEST(Light, CloudInOneLeafGivesTheSamePicture) {
    // no octree at all: the root is the only leaf, and its list is longer than that of any leaf of a real scene
    const std::string path = temporaryPath("root.pro");
    BuildOptions options;
    options.octree.max_depth = 0;
    writeScene(path, sphereSplats(2000, Vec3f(0, 0, 0), 1.0f), options);
    RenderSettings settings = square(48);
    settings.camera.eye = Vec3{0, 0, 4};
    settings.camera.target = Vec3{0, 0, 0};
    const Rendered one = renderFile(path, settings);
    writeScene(path, sphereSplats(2000, Vec3f(0, 0, 0), 1.0f), {});
    const Rendered many = renderFile(path, settings);
    std::remove(path.c_str());
    std::size_t seen = 0, moved = 0;
    for (std::size_t i = 0; i < one.film.depth.size(); ++i) {
        ASSERT_EQ(std::isfinite(one.film.depth[i]), std::isfinite(many.film.depth[i])) << i;
        if (!std::isfinite(one.film.depth[i])) continue;
        ++seen;
        moved += std::abs(one.film.depth[i] - many.film.depth[i]) > 2e-3f;
        EXPECT_NEAR(one.film.depth[i], many.film.depth[i], 0.06) << "a radius";
    }
    std::printf("%zu of %zu pixels moved\n", moved, seen);
    EXPECT_LE(moved, seen / 100) << "at the outline, where rays pass along the discs";
}

} // namespace

} // namespace pointrt::test

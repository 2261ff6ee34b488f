// SPDX-License-Identifier: Apache-2.0
// The shaders' first hits, compared with brute force and with analytic shapes.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <optional>

#include "pointrt/pro_index_layout.h"
#include "runtime/image/film_parts.h"
#include "tests/support/first_hit_check.h"
#include "tests/support/splat_scenes.h"
#include "tests/trace/reference.h"
#include "tests/trace/render_helper.h"

namespace pointrt::test {

namespace {

struct Comparison {
    std::size_t pixels = 0, hits = 0, wrong_hit = 0, wrong_depth = 0, wrong_normal = 0;
    double worst_depth = 0;
};

/// With the blended surface: depth within depth_tolerance (input units), normals within about 1 degree.
Comparison compare(const std::string& path, const Rendered& rendered, double depth_tolerance) {
    const Reference scene = loadReference(path);
    const Film& film = rendered.film;
    RenderSettings settings;
    settings.width = film.width;
    settings.height = film.height;
    Comparison result;
    for (std::uint32_t y = 0; y < film.height; ++y)
        for (std::uint32_t x = 0; x < film.width; ++x) {
            const std::size_t i = std::size_t{y} * film.width + x;
            const Vec3 direction = centerRayDirection(settings, rendered.camera, x, y);
            const auto expected = firstSurface(scene, rendered.camera.eye, direction);
            const bool hit = std::isfinite(film.depth[i]);
            ++result.pixels;
            result.wrong_hit += hit != expected.has_value();
            if (!hit || !expected) continue;
            ++result.hits;
            const double depth_error = std::abs(film.depth[i] - expected->t);
            result.worst_depth = std::max(result.worst_depth, depth_error);
            result.wrong_depth += depth_error > depth_tolerance;
            const Vec3 normal{film.normal[3 * i], film.normal[3 * i + 1], film.normal[3 * i + 2]};
            result.wrong_normal += dot(normal, expected->normal) < 0.9998;
        }
    std::printf("%zu pixels, %zu hits, wrong: hit %zu, depth %zu (at most %.2g), normal %zu\n", result.pixels,
                result.hits, result.wrong_hit, result.wrong_depth, result.worst_depth, result.wrong_normal);
    std::remove(path.c_str());
    return result;
}

/// Compares flat hits with brute force, within the bounds of the rounding of near splats.
struct FlatComparison {
    std::size_t pixels = 0, hits = 0;
    std::size_t same = 0;         ///< hit at the same distance, or missed, in both
    std::size_t wrong_normal = 0; ///< of the same hits: off by more than about 1 degree
    std::size_t unexplained = 0;  ///< beyond those bounds
};

/// Compares in cube units, like the shaders. tolerance: of distances, in input units.
FlatComparison compareFlat(const std::string& path, const Rendered& rendered, double tolerance) {
    const std::vector<CubeSplat> splats = loadCubeSplats(path);
    const NearRounding rounding = nearRounding(splats, rendered.cell_edge);
    const Reference scene = loadReference(path);
    const Film& film = rendered.film;
    const RenderSettings settings = square(film.width);
    const gpu::vec3& eye = rendered.params.eye;
    FlatComparison result;
    for (std::size_t i = 0; i < film.depth.size(); ++i) {
        const Vec3 direction = centerRayDirection(settings, rendered.camera, static_cast<std::uint32_t>(i % film.width),
                                                  static_cast<std::uint32_t>(i / film.width));
        const bool hit = std::isfinite(film.depth[i]);
        ++result.pixels;
        result.hits += hit;
        const auto expected = firstDisc(scene, rendered.camera.eye, direction);
        const bool same =
            hit && expected ? std::abs(film.depth[i] - expected->t) < tolerance : hit == expected.has_value();
        result.same += same;
        const Ray ray{{eye.x, eye.y, eye.z}, direction, {}, 0};
        const std::optional<double> t = hit ? std::optional(film.depth[i] / rendered.info.scale) : std::nullopt;
        result.unexplained += !same && !mayBeFirst(splats, rounding, ray, t);
        if (!same || !hit) continue;
        const Vec3 normal{film.normal[3 * i], film.normal[3 * i + 1], film.normal[3 * i + 2]};
        result.wrong_normal += dot(normal, expected->normal) < 0.9998;
    }
    std::printf("%zu pixels, %zu hits, %zu the same, normal wrong %zu, unexplained %zu\n", result.pixels, result.hits,
                result.same, result.wrong_normal, result.unexplained);
    std::remove(path.c_str());
    return result;
}

/// Least share of pixels whose flat hits equal those of brute force. The others are at rims and ties of discs; for
/// random discs of all sizes, at most 1.5% of the pixels were.
constexpr double kMinSame = 0.985;

class RandomClouds : public testing::TestWithParam<unsigned> {};

TEST_P(RandomClouds, FlatDiscsMatchBruteForce) {
    const unsigned seed = GetParam();
    const std::string path = temporaryPath("random.pro");
    BuildOptions options;
    options.octree.max_leaf_splats = 1 + 3 * (seed % 4);
    writeScene(path, randomSplats(200u << (2 * (seed % 4)), seed, 0.005f, 0.06f), options);
    RenderSettings settings = square(128);
    settings.blend = false;
    const Vec3 eyes[] = {{0.5, 0.5, 3.0}, {-1.0, 0.7, 0.4}, {0.5, 0.5, 0.5}, {2.0, 3.0, -1.0}, {0.5, 100.0, 0.5}};
    settings.camera.eye = eyes[seed % 5];
    settings.camera.target = seed % 5 == 2 ? Vec3{0.9, 0.8, 0.1} : Vec3{0.5, 0.5, 0.5};
    settings.camera.fov_deg = seed % 5 == 4 ? 0.8 : 40;
    // rounding errors of floats; the distant eye is 100 units away
    const FlatComparison result = compareFlat(path, renderFile(path, settings), seed % 5 == 4 ? 1e-4 : 3e-6);
    EXPECT_GT(result.hits, 500u);
    EXPECT_EQ(result.unexplained, 0u);
    EXPECT_GT(static_cast<double>(result.same), kMinSame * static_cast<double>(result.pixels));
    EXPECT_LE(result.wrong_normal, 4u); // if two discs intersect at the hit, rounding selects either
}

INSTANTIATE_TEST_SUITE_P(Seeds, RandomClouds, testing::Range(1u, 11u));

TEST(FirstHits, BlendedSphereMatchesBruteForce) {
    const std::string path = temporaryPath("sphere.pro");
    writeScene(path, sphereSplats(6000, Vec3f(10, -20, 5), 2.0f), {});
    const Comparison result = compare(path, renderFile(path, square(96)), 2e-4);
    EXPECT_GT(result.hits, 2000u);
    EXPECT_LE(result.wrong_hit, 8u); // of about 170 pixels at the silhouette, which consists of rims of discs
    EXPECT_LE(result.wrong_depth, result.hits / 200); // splats with almost no weight in a leaf are not in its list
    EXPECT_LE(result.wrong_normal, result.hits / 200);
}

TEST(FirstHits, PrunedSphereStaysClosedAndRound) {
    const std::string path = temporaryPath("pruned.pro");
    BuildOptions options;
    options.prune = true;
    writeScene(path, sphereSplats(40000, Vec3f(0, 0, 0), 1.0f), options);
    const Rendered rendered = renderFile(path, square(256));
    std::remove(path.c_str());
    std::size_t inside = 0, holes = 0;
    double depth_error = 0, angle_sum = 0, worst_angle = 0;
    for (std::uint32_t y = 0; y < 256; ++y)
        for (std::uint32_t x = 0; x < 256; ++x) {
            const std::size_t i = std::size_t{y} * 256 + x;
            RenderSettings settings = square(256);
            const Vec3 d = centerRayDirection(settings, rendered.camera, x, y), eye = rendered.camera.eye;
            const double b = dot(eye, d), c = dot(eye, eye) - 1.0, discriminant = b * b - c;
            if (discriminant < 0.02) continue; // the silhouette consists of rims of discs
            ++inside;
            if (!std::isfinite(rendered.film.depth[i])) {
                ++holes;
                continue;
            }
            const double t = -b - std::sqrt(discriminant);
            const Vec3 normal = eye + t * d, shown{rendered.film.normal[3 * i], rendered.film.normal[3 * i + 1],
                                                   rendered.film.normal[3 * i + 2]};
            const double angle = std::acos(std::min(1.0, dot(normal, shown))) * 57.29578;
            depth_error = std::max(depth_error, std::abs(rendered.film.depth[i] - t));
            angle_sum += angle;
            worst_angle = std::max(worst_angle, angle);
        }
    std::printf("%zu inside, %zu holes, depth error %.2g, normal error mean %.3f worst %.3f degrees\n", inside, holes,
                depth_error, angle_sum / static_cast<double>(inside), worst_angle);
    EXPECT_GT(inside, 10000u);
    EXPECT_EQ(holes, 0u);
    EXPECT_LT(depth_error, 2e-3); // discs of radius 0.02, whose rims are 2e-4 off the sphere
    EXPECT_LT(angle_sum / static_cast<double>(inside), 0.1);
    EXPECT_LT(worst_angle, 1.2); // a flat disc's normal is up to 1.2 degrees off at its rim
}

TEST(FirstHits, PruningLongListsOpensNoHoles) {
    // leaves that list far more splats than there are probe rays
    const std::string path = temporaryPath("long.pro");
    const auto render = [&](bool prune) {
        BuildOptions options;
        options.octree.max_leaf_splats = 200;
        options.prune = prune;
        writeScene(path, sphereSplats(30000, Vec3f(0, 0, 0), 1.0f), options);
        return renderFile(path, square(400));
    };
    const Rendered full = render(false), pruned = render(true);
    const std::vector<CubeSplat> splats = loadCubeSplats(path);
    std::remove(path.c_str());
    const NearRounding rounding = nearRounding(splats, full.cell_edge);
    std::size_t moved = 0, lost = 0, at_rims = 0;
    for (std::size_t i = 0; i < full.film.depth.size(); ++i) {
        const float before = full.film.depth[i], after = pruned.film.depth[i];
        moved += std::isfinite(before) && std::isfinite(after) && std::abs(before - after) > 0.025; // a radius
        if (std::isfinite(before) == std::isfinite(after)) continue;
        const gpu::vec3& eye = full.params.eye;
        const auto x = static_cast<std::uint32_t>(i % 400), y = static_cast<std::uint32_t>(i / 400);
        const Ray ray{{eye.x, eye.y, eye.z}, centerRayDirection(square(400), full.camera, x, y), {}, 0};
        ++(mayBeFirst(splats, rounding, ray, std::nullopt) ? at_rims : lost);
    }
    std::printf("%zu lost, %zu at rims, %zu moved by more than a radius\n", lost, at_rims, moved);
    EXPECT_EQ(lost, 0u);
    EXPECT_LE(at_rims, 8u); // of 1000 pixels at the silhouette
    EXPECT_EQ(moved, 0u);
}

TEST(FirstHits, AxisParallelRaysEndAndHit) {
    // odd sizes put a centre ray exactly on the axis; the plane crosses the cube's middle, on cell borders of all
    // levels
    const std::string path = temporaryPath("axis.pro");
    writeScene(path, squareSplats(63, Vec3f(0, 0, 0), Vec3f(1, 0, 0), Vec3f(0, 1, 0), 1.2f), {});
    RenderSettings settings = square(65);
    settings.blend = false;
    settings.camera.eye = Vec3{0, 0, 4};
    settings.camera.target = Vec3{0, 0, 0};
    // Stored normals are tilted by half a step of 2/4095 on two axes, 3.5e-4 in all, so the rim of a disc with a radius
    // of 2/63 * 1.2 = 0.038 is off the plane by 1.33e-5. Two overlapping discs may be twice that apart.
    const FlatComparison result = compareFlat(path, renderFile(path, settings), 2.7e-5);
    EXPECT_EQ(result.unexplained, 0u);
    EXPECT_EQ(result.same, result.pixels);
    EXPECT_EQ(result.wrong_normal, 0u);
}

TEST(FirstHits, NationalGridKeepsMillimetres) {
    Splats splats = squareSplats(64, Vec3f(0, 0, 0), Vec3f(1, 0, 0), Vec3f(0, 1, 0), 1.2f);
    splats.origin = Vec3d(512000.25, 5403000.5, 300.125);
    const std::string path = temporaryPath("grid.pro");
    writeScene(path, splats, {});
    const Rendered rendered = renderFile(path, square(64));
    std::remove(path.c_str());
    const std::size_t middle = 32 * 64 + 32;
    EXPECT_NEAR(rendered.camera.eye.z -
                    rendered.film.depth[middle] * -centerRayDirection(square(64), rendered.camera, 32, 32).z,
                300.125, 1e-3);
}

/// A scan over a floor: the table has the scene's materials first, then the scan's only row.
TEST(FirstHits, NameTheMaterialsRow) {
    const SphereFile sphere(6000);
    SceneDescription scene;
    scene.materials.resize(2);
    scene.instances.push_back({sphere.path, {}, {}, {}});
    scene.shapes.push_back({ShapeKind::kDisc, {0, -1, 0}, {3, 0, 0}, {0, 0, -3}, {0, 1, 0}, 1});
    RenderSettings settings = square(48);
    settings.camera.eye = Vec3{0, 1, 6};
    settings.camera.target = Vec3{0, 0, 0};
    const auto materialsAt = [](const Film& film) {
        const std::size_t middle = 24 * 48 + 24, floor = 38 * 48 + 24, above = 24;
        return std::array{film.material_id[middle], film.material_id[floor], film.material_id[above]};
    };
    EXPECT_EQ(materialsAt(renderScene(scene, settings).film), (std::array{2u, 1u, NO_INDEX}));
    // all splats are in that range of colours and have the scene's material itself
    scene.instances[0].overrides.push_back({MaterialOverride::ColorRange{{0, 0, 0}, {255, 255, 255}}, 0, ""});
    EXPECT_EQ(materialsAt(renderScene(scene, settings).film), (std::array{0u, 1u, NO_INDEX}));
}

/// A scene that fills every film part: a scan and a glass ball over a floor, under a lamp.
TEST(FilmParts, AreAllFilled) {
    const SphereFile sphere(2000);
    SceneDescription scene;
    scene.materials.resize(2);
    scene.materials[1].kind = MaterialKind::kGlass;
    scene.instances.push_back({sphere.path, {}, {}, {}});
    scene.shapes.push_back({ShapeKind::kDisc, {0, -1, 0}, {4, 0, 0}, {0, 0, -4}, {0, 1, 0}, 0});
    scene.shapes.push_back({ShapeKind::kSphere, {1.5, 0, 1}, {0.8, 0, 0}, {0, 0.8, 0}, {0, 0, 0.8}, 1});
    scene.lights.push_back(SphereLight{{3, 4, 2}, 0.5, {30, 30, 30}});
    RenderSettings settings = square(32);
    settings.integrator = Integrator::kPath;
    settings.spp = 8;
    settings.camera.eye = Vec3{0, 2, 7};
    settings.camera.target = Vec3{0, 0, 0};
    const Film film = renderScene(scene, settings).film;
    forEachFilmPart(film, [&](const FilmPart& part, const auto& values) {
        ASSERT_EQ(values.size(), part.channels.size() * 32 * 32) << part.channels.front();
        const bool differ = std::any_of(values.begin(), values.end(), [&](auto each) { return each != values[0]; });
        const bool is_even = part.channels.front() == "samples" || part.channels.front() == "id.tile";
        EXPECT_EQ(differ, !is_even) << part.channels.front();
    });
    EXPECT_EQ(film.samples[0], 8.0f);
}

} // namespace

} // namespace pointrt::test

// SPDX-License-Identifier: Apache-2.0
// Rays through scene files, compared with transformed rays through the scans, and with the ids and depths of pictures.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <fstream>
#include <numbers>

#include "runtime/scene_io/scene_file.h"
#include "tests/runtime/rays/set_scenes.h"
#include "tests/support/says.h"
#include "tests/support/splat_scenes.h"
#include "tests/trace/render_helper.h"

namespace pointrt::test {
namespace {

std::string messageOf(const TraceDevice& device, const std::string& path) {
    try {
        const TraceScene scene(device, {path});
    } catch (const TraceError& error) {
        EXPECT_EQ(error.kind, TraceError::Kind::kBadInput);
        return error.what();
    }
    return "nothing was thrown";
}

/// A unit sphere with a quarter of its surface missing, so that hits depend on its rotation.
Splats cap() {
    Splats all = sphereSplats(6000, Vec3f(0, 0, 0), 1), some;
    some.oriented = true;
    for (std::size_t i = 0; i < all.positions.size(); ++i) {
        if (all.positions[i].x() > 0 && all.positions[i].y() > 0) continue;
        some.input_index.push_back(static_cast<std::uint32_t>(some.positions.size()));
        some.positions.push_back(all.positions[i]);
        some.normals.push_back(all.normals[i]);
        some.radii.push_back(all.radii[i]);
    }
    return some;
}

/// input = inverse rotation (world - translation) / scale; the rotation is about z.
struct Stand {
    Vec3 translation;
    double degrees = 0, scale = 1;
    Vec3 turned(Vec3 v, double sign) const {
        const double a = sign * degrees * std::numbers::pi / 180;
        return {std::cos(a) * v.x - std::sin(a) * v.y, std::sin(a) * v.x + std::cos(a) * v.y, v.z};
    }
    Vec3 inputPoint(Vec3 world) const { return (1 / scale) * turned(world - translation, -1); }
    Vec3 inputVector(Vec3 world) const { return (1 / scale) * turned(world, -1); }
    std::string instance(const std::string& file) const {
        const auto n = [](double v) { return std::to_string(v); };
        return "[[instance]]\nfile = \"" + file + "\"\nscale = " + n(scale) + "\ntranslate = [" + n(translation.x) +
               ", " + n(translation.y) + ", " + n(translation.z) +
               "]\nrotate = {axis = [0, 0, 1], degrees = " + n(degrees) + "}\n";
    }
};

TEST(RaysThroughSceneFiles, Instances_AreAtTheirPlacements) {
    const TemporaryFolder folder;
    writeScene(folder.file("cap.pro"), cap(), {});
    const Stand stands[] = {{{500000, 4500000, 100}, 30, 1}, {{500001.5, 4499999.25, 100.5}, -100, 2.5}};
    std::ofstream(folder.file("two.toml")) << stands[0].instance("cap.pro") << stands[1].instance("cap.pro");
    const TraceDevice device;
    const TraceScene scene(device, {folder.file("two.toml")}), alone(device, {folder.file("cap.pro")});
    EXPECT_EQ(scene.instanceCount(), 2u);
    EXPECT_EQ(scene.splatCount(), 2 * alone.splatCount());
    const std::vector<double> rays = raysAround({500001, 4499999.5, 100}, 4, 40000, 1);
    const SceneHits found = castBoth(scene, rays);
    std::vector<SceneHits> expected;
    for (const Stand& stand : stands) {
        std::vector<double> moved;
        for (std::size_t i = 0; i < rays.size() / 6; ++i)
            addRay(moved, stand.inputPoint(originOf(rays, i)), stand.inputVector(directionOf(rays, i)));
        expected.push_back(castBoth(alone, moved));
    }
    std::size_t others = 0, hits = 0;
    for (std::size_t i = 0; i < found.t_hit.size(); ++i) {
        const std::uint32_t nearer = expected[1].t_hit[i] < expected[0].t_hit[i] ? 1 : 0;
        const double t = expected[nearer].t_hit[i];
        const bool hit = std::isfinite(t);
        hits += hit;
        if (found.splat_ids[i] != expected[nearer].splat_ids[i] || found.occluded[i] != (hit ? 1 : 0) ||
            (hit && (found.instance_ids[i] != nearer || std::abs(found.t_hit[i] - t) > 1e-4 * (1 + t)))) {
            ++others;
            continue;
        }
        if (!hit) continue;
        // 1e-9: the precision of doubles at 4.5 million
        ASSERT_LT(length(found.position(i) - (originOf(rays, i) + found.t_hit[i] * directionOf(rays, i))), 1e-9);
        ASSERT_LT(length(found.normal(i) - stands[nearer].turned(expected[nearer].normal(i), 1)), 1e-5) << i;
    }
    std::printf("%zu hits, %zu others\n", hits, others);
    EXPECT_GT(hits, 4000u);
    EXPECT_LE(others, hits / 400); // rims and grazing rays, by the rounding of rotated rays
}

TEST(RaysThroughSceneFiles, Instances_AreNumberedAcrossPaths) {
    const TemporaryFolder folder;
    writeScene(folder.file("cap.pro"), cap(), {});
    std::ofstream(folder.file("two.toml"))
        << Stand{{10, 0, 0}}.instance("cap.pro") << Stand{{20, 0, 0}}.instance("cap.pro");
    const TraceDevice device;
    const TraceScene scene(device, {folder.file("cap.pro"), folder.file("two.toml"), folder.file("cap.pro")});
    std::vector<double> rays;
    for (const double x : {-0.5, 9.5, 19.5}) addRay(rays, {x, -0.1, 9}, {0, 0, -1});
    const SceneHits found = castBoth(scene, rays);
    EXPECT_EQ(found.instance_ids, (std::vector<std::uint32_t>{0, 1, 2})); // 3 is inside 0
    EXPECT_EQ(found.occluded, (std::vector<std::uint8_t>{1, 1, 1}));
}

TEST(RaysThroughSceneFiles, Shapes_AreHitAsCamerasSeeThem) {
    const TemporaryFolder folder;
    std::ofstream(folder.file("shapes.toml"))
        << "[[shape]]\ntype = \"plane\"\npoint = [0, 0, -2]\nnormal = [0, 0, 1]\nbackdrop = true\n"
           "[[shape]]\ntype = \"sphere\"\ncenter = [0, 0, 0]\nradius = 1\n"
           "[[shape]]\ntype = \"box\"\nmin = [3, -1, -1]\nmax = [5, 1, 1]\n"
           "[[shape]]\ntype = \"disc\"\ncenter = [0, 5, 0]\nnormal = [0, 0, 1]\nradius = 1\nseen_by_camera = false\n"
           "[[shape]]\ntype = \"quad\"\ncenter = [0, 9, 0]\nu = [1, 0, 0]\nv = [0, 2, 0]\n";
    const TraceDevice device;
    const TraceScene scene(device, {folder.file("shapes.toml")});
    std::vector<double> rays;
    addRay(rays, {0.6, 0, 5}, {0, 0, -2});    // sphere, at z = 0.8
    addRay(rays, {4, 0.5, 0}, {0, 0, 1});     // box, from inside
    addRay(rays, {0, 5, 5}, {0, 0, -1});      // the hidden disc
    addRay(rays, {0.9, 10.9, 5}, {0, 0, -1}); // the quad's corner
    addRay(rays, {1.1, 10.9, 5}, {0, 0, -1}); // beside it
    const SceneHits found = castBoth(scene, rays);
    const double miss = std::numeric_limits<double>::infinity();
    const double expected[] = {2.1, 1, miss, 5, miss};
    for (std::size_t i = 0; i < 5; ++i) {
        if (std::isfinite(expected[i])) {
            EXPECT_NEAR(found.t_hit[i], expected[i], 1e-12);
        } else {
            EXPECT_EQ(found.t_hit[i], expected[i]);
        }
        EXPECT_EQ(found.occluded[i], std::isfinite(expected[i]) ? 1 : 0);
    }
    EXPECT_EQ(found.splat_ids, std::vector<std::uint32_t>(5, kNoHit));
    EXPECT_EQ(found.instance_ids, (std::vector<std::uint32_t>{255, 255, kNoHit, 255, kNoHit}));
    EXPECT_LT(length(found.normal(0) - Vec3{0.6, 0, 0.8}), 1e-6);
    EXPECT_LT(length(found.normal(1) - Vec3{0, 0, -1}), 1e-6);
}

/// A scene of a file, a set and shapes, in pictures and ray casts.
TEST(RaysThroughSceneFiles, Ids_MatchPictures) {
    const SphereInTiles ball;
    writeScene(ball.folder.file("cap.pro"), cap(), {});
    const Stand set{{-500000.25 * 0.05 - 1, -4500000.5 * 0.05, -130.125 * 0.05}, 0, 0.05}; // around (-1, 0, 0)
    std::ofstream(ball.folder.file("scene.toml"))
        << "up = \"z\"\n"
        << Stand{{1.5, 0.5, 0.2}, 40, 1.2}.instance("cap.pro") << set.instance("ball.proset")
        << "[[shape]]\ntype = \"disc\"\ncenter = [0, 0, -2]\nnormal = [0, 0.1, 1]\nradius = 4\n"
           "[[shape]]\ntype = \"plane\"\npoint = [0, 0, -3]\nnormal = [0, 0, 1]\nbackdrop = true\n"
           "[camera]\neye = [0.5, -9, 4]\ntarget = [0, 0, 0]\nfov = 45\n[[light]]\ntype = \"point\"\n"
           "position = [0, 0, 9]\nintensity = 10\n";
    const SceneDescription description = readSceneFile(ball.folder.file("scene.toml"));
    RenderSettings settings = square(300);
    settings.lights = 0;
    settings.blend = false;
    settings.detail = 0;
    settings.integrator = Integrator::kNormal;
    settings.camera = description.camera;
    const Rendered picture = renderScene(description, settings);
    std::vector<double> rays;
    for (std::uint32_t i = 0; i < 300 * 300; ++i)
        addRay(rays, centerRayOrigin(settings, picture.camera, i % 300, i / 300),
               centerRayDirection(settings, picture.camera, i % 300, i / 300));
    const TraceDevice device;
    const SceneHits found = castBoth(TraceScene(device, {ball.folder.file("scene.toml")}), rays);
    std::size_t others = 0, hits = 0;
    std::vector<std::size_t> of(256);
    for (std::size_t i = 0; i < found.t_hit.size(); ++i) {
        const Film& film = picture.film;
        const bool hit = std::isfinite(film.depth[i]);
        hits += hit;
        const bool same = film.instance_id[i] == found.instance_ids[i] && film.splat_id[i] == found.splat_ids[i] &&
                          film.tile_id[i] == found.tile_ids[i] &&
                          (!hit || std::abs(found.t_hit[i] - double{film.depth[i]}) < 1e-3);
        others += !same;
        if (hit && same) ++of[found.instance_ids[i]];
    }
    std::printf("%zu hits: %zu, %zu, %zu of shapes; %zu others\n", hits, of[0], of[1], of[255], others);
    EXPECT_GT(of[0], 1000u);
    EXPECT_GT(of[1], 1000u);
    EXPECT_GT(of[255], 1000u);
    EXPECT_LE(others, 90u); // 0.1%: rims, where rounding decides
}

TEST(RaysThroughSceneFiles, Errors_NameTheirPlace) {
    const TemporaryFolder folder;
    const TraceDevice device;
    const std::string path = folder.file("scene.toml");
    const auto refused = [&](const std::string& text) {
        std::ofstream(path) << text;
        return messageOf(device, path);
    };
    EXPECT_SAYS(refused("[[instance]]\nfile = \"gone.pro\"\n"),
                path + ":2: key \"instance[0].file\": *\"" + folder.file("gone.pro") + "\"");
    EXPECT_TRUE(refused("[[instance]\n").starts_with(path + ":1: "));
    std::ofstream(folder.file("text.pro")) << "no scan";
    EXPECT_TRUE(refused("[[instance]]\nfile = \"text.pro\"\n").starts_with(folder.file("text.pro") + ": "));
}

} // namespace
} // namespace pointrt::test

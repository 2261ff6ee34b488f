// SPDX-License-Identifier: Apache-2.0
#include "runtime/scene_io/scene_file.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <numbers>
#include <set>
#include <stdexcept>

#include "runtime/scene/sun.h"
#include "tests/runtime/scene_io/scene_file_fixture.h"

namespace pointrt {
namespace {

using std::numbers::pi;

void expectReadVector(Vec3 v, double x, double y, double z) {
    EXPECT_NEAR(v.x, x, 1e-9);
    EXPECT_NEAR(v.y, y, 1e-9);
    EXPECT_NEAR(v.z, z, 1e-9);
}

void expectColor(Color color, double r, double g, double b) {
    EXPECT_NEAR(color[0], r, 1e-4 * std::max(1.0, r));
    EXPECT_NEAR(color[1], g, 1e-4 * std::max(1.0, g));
    EXPECT_NEAR(color[2], b, 1e-4 * std::max(1.0, b));
}

Vec3 apply(const Placement& placement, Vec3 p) {
    const auto& r = placement.rotation;
    return placement.translation + placement.scale * Vec3{dot(r[0], p), dot(r[1], p), dot(r[2], p)};
}

const MaterialDescription& materialNamed(const SceneDescription& scene, const std::string& name) {
    for (const MaterialDescription& each : scene.materials)
        if (each.name == name) return each;
    throw std::runtime_error("no material " + name);
}

TEST(SceneFileName, EndsInToml) {
    EXPECT_TRUE(isSceneFile("a/b.toml"));
    EXPECT_FALSE(isSceneFile("a.toml/b.pro"));
    EXPECT_FALSE(isSceneFile("a.TOML.pro"));
}

TEST_F(SceneFile, ReadsTheWholeFile) {
    const SceneDescription scene = parse("up = [0, 0, 2]\nroom = 'mirror'\n"
                                         "[camera]\neye = [1, 2, 3.5]\ntarget = [-1, 0, 0]\nup = [0, 3, 0]\nfov = 55\n"
                                         "[render]\nintegrator = 'whitted'\nbounces = 7\nspp = 16\nsize = [640, 480]\n"
                                         "[[instance]]\nfile = 'statue.pro'");
    EXPECT_EQ(scene.path, path("scene.toml"));
    expectReadVector(*scene.up, 0, 0, 1);
    EXPECT_EQ(scene.render.room, Room::kMirror);
    expectReadVector(*scene.camera.eye, 1, 2, 3.5);
    expectReadVector(*scene.camera.target, -1, 0, 0);
    expectReadVector(*scene.camera.up, 0, 1, 0);
    EXPECT_EQ(scene.camera.fov_deg, 55);
    EXPECT_EQ(scene.render.integrator, Integrator::kWhitted);
    EXPECT_EQ(scene.render.bounces, 7u);
    EXPECT_EQ(scene.render.spp, 16u);
    EXPECT_EQ(scene.render.size, (PixelSize{640, 480}));
    ASSERT_EQ(scene.instances.size(), 1u);
    EXPECT_EQ(scene.instances[0].path, path("statue.pro"));
}

TEST_F(SceneFile, LeavesMissingKeysUnset) {
    const SceneDescription scene = parseMore("");
    EXPECT_FALSE(scene.up || scene.sky);
    EXPECT_EQ(scene.render, RenderChoices{});
    EXPECT_FALSE(scene.camera.eye || scene.camera.target || scene.camera.up);
    EXPECT_TRUE(scene.materials.empty() && scene.shapes.empty() && scene.lights.empty());
    EXPECT_FALSE(scene.instances[0].material);
    expectReadVector(apply(scene.instances[0].placement, {1, 2, 3}), 1, 2, 3);
}

TEST_F(SceneFile, ReadsParallelProjection) {
    const CameraRequest all = parseMore("[camera]\northo = 'fit'").camera,
                        some = parseMore("[camera]\northo = 2").camera;
    EXPECT_TRUE(all.ortho && !all.ortho_height);
    EXPECT_TRUE(some.ortho);
    EXPECT_EQ(some.ortho_height, 2);
    EXPECT_FALSE(parseMore("[camera]\nfov = 20").camera.ortho);
}

TEST_F(SceneFile, CameraUsesTheScenesUp) {
    expectReadVector(*parseMore("up = [0, 0, 1]").camera.up, 0, 0, 1);
    expectReadVector(*parseMore("up = [0, 0, 1]\n[camera]\nup = [1, 0, 0]").camera.up, 1, 0, 0);
}

TEST_F(SceneFile, PlacesInstances) {
    const SceneDescription scene =
        parse("[[instance]]\nfile = 'statue.pro'\ntranslate = [10, 20, 30]\nscale = 2\n"
              "rotate = [{axis = [0, 0, 5], degrees = 90}, {axis = [1, 0, 0], degrees = 90}]\n"
              "[[instance]]\nfile = 'dragon.pro'\nrotate = {axis = [0, 1, 0], degrees = 90}");
    // x becomes y by the rotation about z, then z by the one about x
    expectReadVector(apply(scene.instances[0].placement, {1, 0, 0}), 10, 20, 32);
    expectReadVector(apply(scene.instances[0].placement, {0, 1, 0}), 8, 20, 30);
    expectReadVector(apply(scene.instances[0].placement, {0, 0, 1}), 10, 18, 30);
    expectReadVector(apply(scene.instances[1].placement, {1, 0, 0}), 0, 0, -1);
    expectReadVector(apply(scene.instances[1].placement, {0, 0, 1}), 1, 0, 0);
}

TEST_F(SceneFile, OverridesMaterials) {
    const SceneDescription scene = parse("[material.a]\n[material.b]\nkind = 'glass'\n"
                                         "[[instance]]\nfile = 'statue.pro'\nmaterial = 'b'\n"
                                         "[[instance.override]]\nrow = 255\nmaterial = 'a'\n"
                                         "[[instance.override]]\ncolors = ['#0102Fe', '#aB03ff']\nmaterial = 'b'\n");
    const InstanceDescription& instance = scene.instances[0];
    EXPECT_EQ(scene.materials[*instance.material].name, "b");
    ASSERT_EQ(instance.overrides.size(), 2u);
    EXPECT_EQ(std::get<MaterialOverride::Row>(instance.overrides[0].splats).row, 255u);
    EXPECT_EQ(scene.materials[instance.overrides[0].material].name, "a");
    const auto& range = std::get<MaterialOverride::ColorRange>(instance.overrides[1].splats);
    EXPECT_EQ(range.low, (std::array<std::uint8_t, 3>{0x01, 0x02, 0xFE}));
    EXPECT_EQ(range.high, (std::array<std::uint8_t, 3>{0xAB, 0x03, 0xFF}));
    EXPECT_EQ(scene.materials[instance.overrides[1].material].name, "b");
}

TEST_F(SceneFile, OverridesByAttributes) {
    const SceneDescription scene =
        parse("[material.a]\n[[instance]]\nfile = 'statue.pro'\n"
              "[[instance.override]]\nattribute = 'class'\nvalues = [6, -2.5]\nmaterial = 'a'\n"
              "[[instance.override]]\nattribute = 'rgb16.1'\nrange = [1, 1e300]\nmaterial = 'a'\n");
    const auto numbers = [&](std::size_t i) {
        return std::get<SplatSelection>(scene.instances[0].overrides.at(i).splats);
    };
    EXPECT_EQ(numbers(0), (SplatSelection{"class", {{6, 6}, {-2.5, -2.5}}}));
    EXPECT_EQ(numbers(1), (SplatSelection{"rgb16.1", {{1, 1e300}}}));
}

TEST_F(SceneFile, AcceptsAxisNamesForUp) {
    EXPECT_FALSE(parseMore("up = 'auto'").up);
    const SceneDescription plain = parseMore("up = [0, 0, 2]"),
                           scene = parseMore("up = 'z'\n[camera]\nfov = 30\n[[view]]\nname = 'a'");
    EXPECT_EQ(plain.up, (Vec3{0, 0, 1}));
    EXPECT_EQ(scene.up, plain.up);
    EXPECT_EQ(plain.camera.side, (Vec3{0, 0, 1})) << "the default";
    EXPECT_EQ(scene.camera.side, (Vec3{0, -1, 0})) << "its front";
    EXPECT_EQ(scene.views[0].camera.side, (Vec3{0, -1, 0}));
}

TEST_F(SceneFile, ColoursByAttributes) {
    const RenderChoices said =
        parseMore("[render]\ncolor_by = 'class'\ncolor_map = 'turbo'\ncolor_range = [-1, 2.5]\nlegend = true").render;
    EXPECT_EQ(said.color_by, "class");
    EXPECT_EQ(said.color_map, ColorMap::kTurbo);
    EXPECT_EQ(said.color_range, (ValueRange{-1, 2.5}));
    EXPECT_EQ(said.legend, true);
}

TEST_F(SceneFile, ReadsABackground) {
    EXPECT_EQ(parseMore("background = 'transparent'").render.background, (Background{{0, 0, 0}, true}));
    EXPECT_EQ(parseMore("background = '#FF8000'").render.background, (Background{{255, 128, 0}, false}));
    EXPECT_FALSE(parseMore("").render.background);
}

TEST_F(SceneFile, ReadsMaterials) {
    const SceneDescription scene =
        parseMore("[material.m]\ncolor = [0.1, 0.2, 0.3]\nmirror_share = 0.4\nspecular = 0.5\nshininess = 60\nemission "
                  "= [7, 8, 9]\n"
                  "[material.gold]\nkind = 'metal'\ncolor = '#ff8000'\nroughness = 0.25\n"
                  "[material.p]\nkind = 'plastic'\nindex = 1.6\nroughness = 0\nsplat_color = false\n"
                  "[material.c]\nkind = 'mirror'\n"
                  "[material.g]\nkind = 'glass'\nindex = 1.3\nabsorption = [1, 2, 3]\nsplat_color = true\n"
                  "[material.pane]\nkind = 'glass'\nthin = true\ncolor = [1, 0.5, 1]\n"
                  "[material.t]\nkind = 'glass'\ntint = [1, 0.5, 0.25]\ntint_distance = 2\n");
    const MaterialDescription m = materialNamed(scene, "m"), gold = materialNamed(scene, "gold");
    EXPECT_EQ(m.kind, MaterialKind::kMatte);
    expectColor(m.color, 0.1, 0.2, 0.3);
    expectColor(m.emission, 7, 8, 9);
    EXPECT_FLOAT_EQ(m.mirror_share, 0.4f);
    EXPECT_FLOAT_EQ(m.specular, 0.5f);
    EXPECT_FLOAT_EQ(m.shininess, 60);
    EXPECT_EQ(gold.kind, MaterialKind::kMetal);
    expectColor(gold.color, 1, 0.21586, 0); // IEC 61966-2-1: 128/255 is 0.21586
    EXPECT_FLOAT_EQ(gold.roughness, 0.25f);
    const MaterialDescription p = materialNamed(scene, "p"), g = materialNamed(scene, "g");
    EXPECT_EQ(p.kind, MaterialKind::kPlastic);
    EXPECT_FLOAT_EQ(p.index, 1.6f);
    EXPECT_EQ(p.roughness, 0);
    EXPECT_EQ(materialNamed(scene, "c").kind, MaterialKind::kMirror);
    EXPECT_EQ(g.kind, MaterialKind::kGlass);
    EXPECT_FLOAT_EQ(g.index, 1.3f);
    expectColor(g.absorption, 1, 2, 3);
    EXPECT_TRUE(g.splat_color && materialNamed(scene, "pane").thin);
    expectColor(materialNamed(scene, "pane").color, 1, 0.5, 1);
    // exp(-2 a) is the tint
    expectColor(materialNamed(scene, "t").absorption, 0, std::log(2.0) / 2, std::log(4.0) / 2);
}

TEST_F(SceneFile, UsesSplatColoursByDefault) {
    const SceneDescription scene = parseMore("[material.a]\n[material.b]\ncolor = [0.5, 0.5, 0.5]\n"
                                             "[material.c]\nsplat_color = false\n[material.d]\nkind = 'mirror'\n"
                                             "[material.e]\ncolor = [0.5, 0.5, 0.5]\nsplat_color = true\n");
    EXPECT_TRUE(materialNamed(scene, "a").splat_color && materialNamed(scene, "e").splat_color);
    expectColor(materialNamed(scene, "a").color, 1, 1, 1);
    expectColor(materialNamed(scene, "e").color, 0.5, 0.5, 0.5);
    EXPECT_FALSE(materialNamed(scene, "b").splat_color || materialNamed(scene, "c").splat_color);
    expectColor(materialNamed(scene, "c").color, 0.8, 0.8, 0.8);
    EXPECT_FALSE(materialNamed(scene, "d").splat_color);
    expectColor(materialNamed(scene, "d").color, 1, 1, 1);
}

void expectFrame(const ShapeDescription& shape, Vec3 w, double u_length, double v_length) {
    expectReadVector(shape.w, w.x, w.y, w.z);
    EXPECT_NEAR(length(shape.u), u_length, 1e-9);
    EXPECT_NEAR(length(shape.v), v_length, 1e-9);
    const Vec3 normal = normalize(cross(shape.u, shape.v)), out = normalize(w);
    expectReadVector(normal, out.x, out.y, out.z);
    EXPECT_NEAR(dot(shape.u, shape.v), 0, 1e-9);
}

TEST_F(SceneFile, ReadsFlatShapes) {
    const SceneDescription scene =
        parse("[material.f]\ncolor = [0.1, 0.1, 0.1]\n"
              "[[shape]]\ntype = 'plane'\npoint = [1, 2, 3]\nnormal = [0, 0, -4]\nmaterial = 'f'\n"
              "[[shape]]\ntype = 'disc'\ncenter = [4, 5, 6]\nnormal = [3, 4, 0]\nradius = 2.5\nseen_by_camera = false\n"
              "[[shape]]\ntype = 'quad'\ncenter = [7, 8, 9]\nu = [2, 0, 0]\nv = [0, 0, 3]\n"
              "[[shape]]\ntype = 'quad'\ncenter = [0, 0, 0]\nu = [0.707, 0.707, 0]\nv = [-0.707, 0.708, 0]\n");
    ASSERT_EQ(scene.shapes.size(), 4u);
    EXPECT_EQ(scene.shapes[0].kind, ShapeKind::kPlane);
    expectReadVector(scene.shapes[0].center, 1, 2, 3);
    expectFrame(scene.shapes[0], {0, 0, -1}, 1, 1);
    EXPECT_EQ(scene.materials[scene.shapes[0].material].name, "f");
    EXPECT_EQ(scene.shapes[1].kind, ShapeKind::kDisc);
    expectReadVector(scene.shapes[1].center, 4, 5, 6);
    expectFrame(scene.shapes[1], {0.6, 0.8, 0}, 2.5, 2.5);
    EXPECT_TRUE(scene.shapes[0].seen_by_camera && !scene.shapes[1].seen_by_camera);
    EXPECT_EQ(scene.shapes[2].kind, ShapeKind::kQuad);
    expectReadVector(scene.shapes[2].center, 7, 8, 9);
    expectFrame(scene.shapes[2], {0, -1, 0}, 2, 3);
    EXPECT_NEAR(dot(scene.shapes[3].u, scene.shapes[3].v), 0, 1e-12);
    // shapes that name no material share a matte one
    EXPECT_EQ(scene.shapes[1].material, scene.shapes[2].material);
    ASSERT_EQ(scene.materials.size(), 2u);
    expectColor(scene.materials[1].color, 0.8, 0.8, 0.8);
    EXPECT_FALSE(scene.materials[1].splat_color);
}

TEST_F(SceneFile, ReadsSolidShapes) {
    const SceneDescription scene = parse(
        "[[shape]]\ntype = 'box'\nmin = [0, 1, 2]\nmax = [2, 5, 8]\n"
        "[[shape]]\ntype = 'box'\ncenter = [1, 1, 1]\nsize = [2, 4, 6]\nrotate = {axis = [0, 0, 1], degrees = 90}\n"
        "[[shape]]\ntype = 'sphere'\ncenter = [1, 2, 3]\nradius = 0.5\n");
    EXPECT_EQ(scene.shapes[0].kind, ShapeKind::kBox);
    expectReadVector(scene.shapes[0].center, 1, 3, 5);
    expectReadVector(scene.shapes[0].u, 1, 0, 0);
    expectReadVector(scene.shapes[0].v, 0, 2, 0);
    expectReadVector(scene.shapes[0].w, 0, 0, 3);
    expectReadVector(scene.shapes[1].u, 0, 1, 0);
    expectReadVector(scene.shapes[1].v, -2, 0, 0);
    expectReadVector(scene.shapes[1].w, 0, 0, 3);
    EXPECT_EQ(scene.shapes[2].kind, ShapeKind::kSphere);
    expectReadVector(scene.shapes[2].center, 1, 2, 3);
    expectFrame(scene.shapes[2], {0, 0, 0.5}, 0.5, 0.5);
}

TEST_F(SceneFile, ReadsPointsAndSpots) {
    const SceneDescription scene = parseMore(
        "[[light]]\ntype = 'point'\nposition = [1, 2, 3]\ncolor = [1, 0.5, 0]\nintensity = 4\n"
        "[[light]]\ntype = 'point'\nposition = [0, 0, 0]\npower = 100\n"
        "[[light]]\ntype = 'spot'\nposition = [1, 1, 1]\ndirection = [0, -2, 0]\nintensity = [5, 6, 7]\n"
        "[[light]]\ntype = 'spot'\nposition = [1, 1, 1]\ntarget = [1, 1, 9]\nouter = 60\ninner = 10\nintensity = 1\n"
        "[[light]]\ntype = 'spot'\nposition = [1, 1, 1]\ntarget = [1, 1, 9]\nouter = 12\nintensity = 1\n");
    const auto& point = std::get<PointLight>(scene.lights[0]);
    expectReadVector(point.position, 1, 2, 3);
    expectColor(point.intensity, 4, 2, 0);
    expectColor(std::get<PointLight>(scene.lights[1]).intensity, 25 / pi, 25 / pi, 25 / pi);
    const auto &spot = std::get<SpotLight>(scene.lights[2]), &wide = std::get<SpotLight>(scene.lights[3]);
    expectReadVector(spot.position, 1, 1, 1);
    expectReadVector(spot.direction, 0, -1, 0);
    expectColor(spot.intensity, 5, 6, 7);
    EXPECT_EQ(spot.outer_deg, 30);
    EXPECT_EQ(spot.inner_deg, 25);
    expectReadVector(wide.direction, 0, 0, 1);
    EXPECT_EQ(wide.outer_deg, 60);
    EXPECT_EQ(wide.inner_deg, 10);
    EXPECT_NEAR(std::get<SpotLight>(scene.lights[4]).inner_deg, 10, 1e-12);
}

TEST_F(SceneFile, ReadsAreaLights) {
    const SceneDescription scene =
        parseMore("[[light]]\ntype = 'sphere'\ncenter = [1, 2, 3]\nradius = 2\nradiance = 3\nseen_by_camera = false\n"
                  "[[light]]\ntype = 'sphere'\ncenter = [1, 2, 3]\nradius = 2\npower = 100\ncolor = [1, 0.5, 0]\n"
                  "[[light]]\ntype = 'quad'\ncenter = [4, 5, 6]\nu = [2, 0, 0]\nv = [0, 3, 0]\nradiance = [1, 2, 3]\n"
                  "[[light]]\ntype = 'quad'\ncenter = [4, 5, 6]\nu = [2, 0, 0]\nv = [0, 3, 0]\npower = 480\n");
    const auto& sphere = std::get<SphereLight>(scene.lights[0]);
    expectReadVector(sphere.center, 1, 2, 3);
    EXPECT_EQ(sphere.radius, 2);
    expectColor(sphere.radiance, 3, 3, 3);
    EXPECT_FALSE(sphere.seen_by_camera);
    // power is pi * radiance * area: 16 pi here, and 2 * 24 for both sides of the quad
    const double radiance = 100 / (pi * 16 * pi);
    expectColor(std::get<SphereLight>(scene.lights[1]).radiance, radiance, radiance / 2, 0);
    const auto& quad = std::get<QuadLight>(scene.lights[2]);
    expectReadVector(quad.center, 4, 5, 6);
    expectReadVector(quad.u, 2, 0, 0);
    expectReadVector(quad.v, 0, 3, 0);
    expectColor(quad.radiance, 1, 2, 3);
    EXPECT_TRUE(quad.seen_by_camera);
    expectColor(std::get<QuadLight>(scene.lights[3]).radiance, 10 / pi, 10 / pi, 10 / pi);
}

TEST_F(SceneFile, ReadsDiscLights) {
    const SceneDescription scene =
        parseMore("[[light]]\ntype = 'disc'\ncenter = [1, 2, 3]\nnormal = [0, 0, -4]\nradius = 2\nradiance = 3\n"
                  "[[light]]\ntype = 'disc'\ncenter = [1, 2, 3]\ntarget = [1, -2, 0]\nradius = 2\npower = 80\n"
                  "color = [1, 0.5, 0]\nseen_by_camera = false\n");
    const auto &plain = std::get<DiscLight>(scene.lights[0]), &aimed = std::get<DiscLight>(scene.lights[1]);
    expectReadVector(plain.center, 1, 2, 3);
    expectReadVector(plain.normal, 0, 0, -1);
    EXPECT_EQ(plain.radius, 2);
    expectColor(plain.radiance, 3, 3, 3);
    EXPECT_TRUE(plain.seen_by_camera);
    expectReadVector(aimed.normal, 0, -0.8, -0.6);
    // pi * radiance * area, of both sides: 8 pi
    expectColor(aimed.radiance, 10 / (pi * pi), 5 / (pi * pi), 0);
    EXPECT_FALSE(aimed.seen_by_camera);
}

TEST_F(SceneFile, PlacesTheSunByTimeAndPlace) {
    const std::string place = "latitude = 39.742476\nlongitude = -105.1786\nirradiance = 2\n";
    const std::string when = "[[light]]\ntype = 'sun'\ntime = 2003-10-17T12:30:30-07:00\n" + place;
    // NREL/TP-560-34302, table A5.1: 39.87 over the horizon, 0.02 more as seen, azimuth 194.34
    const Vec3 expected = sunDirection({39.89, 194.34}, {0, 1, 0}, {0, 0, -1});
    const auto sun = std::get<SunLight>(parseMore("up = [0, 1, 0]\n" + when).lights[0]);
    EXPECT_NEAR(length(sun.towards - expected), 0, 0.001);
    EXPECT_EQ(sun.radius_deg, 0.2665);
    expectColor(sun.irradiance, 2, 2, 2);
    const SceneDescription waiting = parseMore("[[light]]\ntype='point'\nposition=[0,0,0]\nintensity=1\n" + when);
    ASSERT_EQ(waiting.suns.size(), 1u) << "the scan may have an up direction";
    EXPECT_EQ(waiting.suns[0].light, 1u);
    EXPECT_NEAR(waiting.suns[0].position.azimuth_deg, 194.34, 0.01);
    const auto standing = std::get<SunLight>(parseMore("up = [0, 0, 1]\n" + when + "north = [1, 0, 5]").lights[0]);
    EXPECT_NEAR(length(standing.towards - sunDirection({39.89, 194.34}, {0, 0, 1}, {1, 0, 0})), 0, 0.001);
    const auto plain = std::get<SunLight>(
        parseMore("[[light]]\ntype='sun'\ntowards=[0, 3, 4]\nirradiance=1\nangular_radius=0\n").lights[0]);
    expectReadVector(plain.towards, 0, 0.6, 0.8);
    EXPECT_EQ(plain.radius_deg, 0);
}

TEST_F(SceneFile, ReadsTheSky) {
    SkyDescription sky =
        *parseMore("[sky]\nzenith=[1,2,3]\nhorizon=[4,5,6]\nground=[7,8,9]\nstrength=2\nambient=0.5").sky;
    expectColor(sky.zenith, 1, 2, 3);
    expectColor(sky.horizon, 4, 5, 6);
    expectColor(sky.ground, 7, 8, 9);
    EXPECT_EQ(sky.strength, 2);
    EXPECT_EQ(sky.ambient, 0.5f);
    EXPECT_EQ(sky.image, "");
    sky = *parseMore("[sky]\ncolor='#ffffff'").sky;
    for (const Color& color : {sky.zenith, sky.horizon, sky.ground}) expectColor(color, 1, 1, 1);
    sky = *parseMore("[sky]\nimage='sky.exr'\nrotation=-90").sky;
    EXPECT_EQ(sky.image, path("sky.exr"));
    EXPECT_EQ(sky.rotation_deg, -90);
    sky = *parseMore("[sky]").sky;
    expectColor(sky.zenith, 0.46, 0.52, 0.62);
}

TEST_F(SceneFile, ReadsRenderSettings) {
    const SceneDescription scene =
        parseMore("staged_for = [1, 2, 3]\n[render]\nseed=7\ndenoise='off'\nexposure=-1.5\nlights=4\nshadows=false\n"
                  "caustics=false\nblend=false\nrelight=true\nreflectivity=0.25");
    expectReadVector(*scene.staged_for, 1, 2, 3);
    EXPECT_EQ(scene.render.seed, 7u);
    EXPECT_EQ(scene.render.denoise, DenoiseChoice::kOff);
    EXPECT_EQ(scene.render.exposure, -1.5f);
    EXPECT_EQ(scene.render.lights, 4u);
    EXPECT_EQ(scene.render.shadows, false);
    EXPECT_EQ(scene.render.caustics, false);
    EXPECT_EQ(scene.render.blend, false);
    EXPECT_EQ(scene.render.relight, true);
    EXPECT_EQ(scene.render.reflectivity, 0.25f);
}

TEST_F(SceneFile, ReadsViews) {
    const SceneDescription scene =
        parseMore("up=[0, 0, 1]\n[camera]\neye=[9, 9, 9]\nfov=20\n[[view]]\nname='top'\neye=[0, 0, 5]\n"
                  "target=[0, 0, 1]\nup=[0, 2, 0]\nfov=30\n[[view]]\nname='the other side'\northo=2.5");
    ASSERT_EQ(scene.views.size(), 2u);
    EXPECT_EQ(scene.views[0].name, "top");
    expectReadVector(*scene.views[0].camera.eye, 0, 0, 5);
    expectReadVector(*scene.views[0].camera.target, 0, 0, 1);
    expectReadVector(*scene.views[0].camera.up, 0, 1, 0);
    EXPECT_EQ(scene.views[0].camera.fov_deg, 30);
    EXPECT_FALSE(scene.views[1].camera.eye) << "not the camera's";
    expectReadVector(*scene.views[1].camera.up, 0, 0, 1);
    EXPECT_EQ(scene.views[1].camera.ortho_height, 2.5);
}

TEST_F(SceneFile, KeepsMatricesUnchanged) {
    const SceneDescription scene =
        parse("[[instance]]\nfile='statue.pro'\nrotate={ matrix=[[0, 0, 1], [1, 0, 0], [0, 1, 0]] }\n"
              "[[shape]]\ntype='disc'\ncenter=[1, 2, 3]\naxes=[[0, 2, 0], [0, 0, 2], [1, 0, 0]]\nbackdrop=true");
    expectReadVector(scene.instances[0].placement.rotation[0], 0, 0, 1);
    expectReadVector(scene.instances[0].placement.rotation[2], 0, 1, 0);
    expectReadVector(scene.shapes[0].center, 1, 2, 3);
    expectReadVector(scene.shapes[0].u, 0, 2, 0);
    expectReadVector(scene.shapes[0].v, 0, 0, 2);
    expectReadVector(scene.shapes[0].w, 1, 0, 0);
    EXPECT_TRUE(scene.shapes[0].backdrop);
}

TEST_F(SceneFile, ReadsTheExample) {
    std::filesystem::copy_file(POINTRT_EXAMPLE_SCENE, folder_ / "example.toml");
    const SceneDescription scene = readSceneFile(path("example.toml"));
    EXPECT_EQ(scene.instances.size(), 2u);
    EXPECT_EQ(scene.instances[1].overrides.size(), 2u);
    EXPECT_EQ(scene.lights.size(), 5u);
    EXPECT_EQ(scene.render.integrator, Integrator::kPath);
    std::set<ShapeKind> shapes;
    std::set<MaterialKind> materials;
    for (const ShapeDescription& each : scene.shapes) shapes.insert(each.kind);
    for (const MaterialDescription& each : scene.materials) materials.insert(each.kind);
    EXPECT_EQ(shapes.size(), 5u);
    EXPECT_EQ(materials.size(), 5u);
    // the example's comment gives the same colour in another form
    expectColor(materialNamed(scene, "floor").color, 0.43415, 0.39157, 0.31399);
}

} // namespace
} // namespace pointrt

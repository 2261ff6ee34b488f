// SPDX-License-Identifier: Apache-2.0
// Caustics of mirrors and glass by photons, compared with closed forms, and with paths that hit lamps by chance.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <numbers>
#include <string>
#include <utility>
#include <vector>

#include "tests/support/splat_scenes.h"
#include "tests/trace/render_helper.h"

namespace pointrt::test {

namespace {

using std::numbers::pi;

constexpr std::uint32_t kCausticsSize = 48;

MaterialDescription material(MaterialKind kind, float color = 1) {
    MaterialDescription m;
    m.kind = kind;
    m.color = {color, color, color};
    return m;
}

Color grey(double value) {
    const auto v = static_cast<float>(value);
    return {v, v, v};
}

ShapeDescription floorAt(double height, double half, std::uint32_t material_number) {
    return {ShapeKind::kQuad, {0, height, 0}, {half, 0, 0}, {0, 0, -half}, {0, 1, 0}, material_number};
}

ShapeDescription ballAt(Vec3 center, double radius, std::uint32_t material_number) {
    return {ShapeKind::kSphere, center, {radius, 0, 0}, {0, radius, 0}, {0, 0, radius}, material_number};
}

RenderSettings view(Integrator integrator, std::uint32_t spp, bool caustics = true) {
    RenderSettings settings = square(kCausticsSize);
    settings.integrator = integrator;
    settings.spp = spp;
    settings.bounces = 12;
    settings.caustics = caustics;
    settings.camera.eye = Vec3{0, 9, 5};
    settings.camera.target = Vec3{0, -1.6, 0};
    settings.camera.fov_deg = 40;
    return settings;
}

/// Means of one channel (of three or four) over parts x parts parts of the picture. Pixels count as 0 unless
/// use(position) holds for them and their neighbours, because pixels at edges have light of both sides.
template <typename Use>
std::vector<double> regionMeans(const Film& film, const std::vector<float>& layer, std::uint32_t parts,
                                const Use& use) {
    std::vector<double> sums(parts * parts);
    const std::size_t stride = layer.size() / film.samples.size();
    const double share = static_cast<double>(parts * parts) / static_cast<double>(film.samples.size());
    for (std::uint32_t i = 0; i < film.samples.size(); ++i) {
        const std::uint32_t x = i % film.width, y = i / film.width;
        bool used = true;
        for (std::uint32_t ny = y - (y > 0); ny <= std::min(y + 1, film.height - 1); ++ny)
            for (std::uint32_t nx = x - (x > 0); nx <= std::min(x + 1, film.width - 1); ++nx) {
                const float* at = film.position.data() + 3 * (std::size_t{ny} * film.width + nx);
                used &= use(Vec3{at[0], at[1], at[2]});
            }
        EXPECT_TRUE(std::isfinite(layer[stride * i]));
        if (used) sums[y * parts / film.height * parts + x * parts / film.width] += share * layer[stride * i];
    }
    return sums;
}

double sumOf(const std::vector<double>& values) {
    double sum = 0;
    for (const double value : values) sum += value;
    return sum;
}

// Caustics alone, on a floor so dark that its reflection is negligible.

constexpr double kFloor = -1.6;
constexpr float kDark = 0.02f;
const Vec3 kLampAt{1.5, 7, 0.5};

SceneDescription onDarkFloor(SceneDescription scene, Vec3 lamp) {
    const auto number = static_cast<std::uint32_t>(scene.materials.size());
    scene.materials.push_back(material(MaterialKind::kMatte, kDark));
    scene.shapes.push_back(floorAt(kFloor, 8, number));
    scene.lights = {SphereLight{lamp, 2.5, {10, 10, 10}}};
    return scene;
}

/// A view in which the body does not hide its caustic.
RenderSettings overlook(Vec3 eye, Vec3 target, Integrator integrator, std::uint32_t spp, bool caustics) {
    RenderSettings settings = view(integrator, spp, caustics);
    settings.camera.eye = eye;
    settings.camera.target = target;
    return settings;
}

/// Compares the light of photons on the floor with that of paths through mirrors and glass: in total, and as the mean
/// difference of the picture's parts, relative to their mean.
void expectCausticOfPaths(const char* what, const SceneDescription& scene, Vec3 eye, Vec3 target, std::uint32_t spp) {
    const auto onFloor = [](Vec3 at) { return std::abs(at.y - kFloor) < 1e-3; };
    const Rendered photons = renderScene(scene, overlook(eye, target, Integrator::kWhitted, 16, true));
    const Rendered paths = renderScene(scene, overlook(eye, target, Integrator::kPath, spp, false));
    const auto seen = regionMeans(photons.film, photons.film.caustic, 8, onFloor);
    const auto known = regionMeans(paths.film, paths.film.indirect, 8, onFloor);
    double difference = 0;
    for (std::size_t part = 0; part < seen.size(); ++part) difference += std::abs(seen[part] - known[part]);
    const double total = sumOf(seen) / sumOf(known) - 1;
    std::printf("%s: caustic %+.2f%% in all, %.2f%% in parts\n", what, 100 * total, 100 * difference / sumOf(known));
    EXPECT_GT(sumOf(known), 0);
    EXPECT_LT(std::abs(total), 0.02);
    EXPECT_LT(difference, 0.1 * sumOf(known));
}

const Vec3 kSideLamp{7, 7, 0}, kOtherSide{-6, 6, 0}, kBallsCaustic{-1.5, kFloor, 0};

TEST(Caustics, OfAGlassBall) {
    expectCausticOfPaths("glass ball", onDarkFloor(analyticSphere(material(MaterialKind::kGlass)), kSideLamp),
                         kOtherSide, kBallsCaustic, 1024);
}

TEST(Caustics, OfAGlassBallOfSplats) {
    const SphereFile file(20000);
    expectCausticOfPaths("glass ball of splats",
                         onDarkFloor(splatBody(file.path, material(MaterialKind::kGlass)), kSideLamp), kOtherSide,
                         kBallsCaustic, 768);
}

/// A ring, open above and below, with normals outwards.
Splats ringSplats(double radius, double low, double high, std::size_t around) {
    Splats splats;
    splats.oriented = true;
    const double spacing = 2 * pi * radius / static_cast<double>(around);
    for (double y = low; y <= high; y += spacing)
        for (std::size_t i = 0; i < around; ++i) {
            const double angle = 2 * pi * static_cast<double>(i) / static_cast<double>(around);
            const Vec3f normal = Vec3d(std::cos(angle), 0, std::sin(angle)).cast<float>();
            splats.input_index.push_back(static_cast<std::uint32_t>(splats.positions.size()));
            splats.positions.push_back(static_cast<float>(radius) * normal + Vec3f(0, static_cast<float>(y), 0));
            splats.normals.push_back(normal);
            splats.radii.push_back(static_cast<float>(1.2 * spacing));
        }
    return splats;
}

TEST(Caustics, OfAMirrorRingOfSplats) {
    const std::string path = temporaryPath("ring.pro");
    // above the floor: photon discs blur a caustic at the foot of the wall across the wall
    writeScene(path, ringSplats(1.5, kFloor + 0.6, kFloor + 1.2, 400), {});
    expectCausticOfPaths("mirror ring of splats",
                         onDarkFloor(splatBody(path, material(MaterialKind::kMirror, 0.9f)), {5, 5, 0}), {0, 9, 0.1},
                         {0, kFloor, 0}, 768);
    std::remove(path.c_str());
}

// Whole pictures, with photons and without.

struct BrightScene {
    const char* name;
    SceneDescription scene;
    bool gathers = true; ///< whether the floor gathers photons
};

SceneDescription brightScene(std::vector<MaterialDescription> materials, std::vector<ShapeDescription> shapes,
                             const LightDescription& light) {
    SceneDescription scene;
    scene.materials = std::move(materials);
    scene.materials.insert(scene.materials.begin(), material(MaterialKind::kMatte, 0.7f));
    scene.shapes = std::move(shapes);
    scene.shapes.push_back(floorAt(kFloor, 4, 0));
    scene.lights = {light};
    scene.sky = evenSky(0.05f);
    return scene;
}

std::vector<BrightScene> brightCases() {
    const SphereLight ball{kLampAt, 2.5, {3, 3, 3}};
    const QuadLight quad{kLampAt, {2, 0, 0}, {0, 0, 2}, {3, 3, 3}};
    const MaterialDescription glass = material(MaterialKind::kGlass);
    MaterialDescription absorbing = glass, gloss = material(MaterialKind::kMatte, 0.6f),
                        metal = material(MaterialKind::kMetal, 0.9f), plastic = material(MaterialKind::kPlastic, 0.5f),
                        pane = glass;
    absorbing.absorption = {0.7f, 0.7f, 0.7f};
    gloss.mirror_share = 0.4f;
    metal.roughness = 0.3f;
    plastic.roughness = 0.4f;
    pane.thin = true;
    const ShapeDescription body = ballAt({0, 0, 0}, 1, 1), beside = ballAt({-1.6, kFloor + 0.7, 1}, 0.7, 2);
    const ShapeDescription slab{ShapeKind::kQuad, {0.5, 0.5, 0}, {2, 0, 0}, {0, 0, -2}, {0, 1, 0}, 1};
    std::vector<BrightScene> cases{
        {"sphere lamp", brightScene({glass}, {body}, ball)},
        {"quad lamp", brightScene({glass}, {body}, quad)},
        {"sun", brightScene({glass}, {body}, SunLight{normalize(kLampAt), 15, {3, 3, 3}})},
        {"huge lamp, close", brightScene({glass}, {body}, SphereLight{{5.3, 1, 0}, 4, {1, 1, 1}})},
        {"matte with a mirror share", brightScene({gloss}, {body}, ball)},
        {"metal beside", brightScene({glass, metal}, {body, beside}, ball)},
        {"plastic beside", brightScene({glass, plastic}, {body, beside}, ball)},
        {"absorbing", brightScene({absorbing}, {body}, ball)},
        {"matte inside glass",
         brightScene({glass, material(MaterialKind::kMatte, 0.5f)}, {body, ballAt({0, 0, 0}, 0.5, 2)}, ball)},
        {"lamp inside glass",
         brightScene({glass}, {ballAt({0, 0, 0}, 1.2, 1)}, SphereLight{{0, 0.2, 0}, 0.4, {3, 3, 3}})},
        {"two bodies", brightScene({glass}, {body, ballAt({0.8, 2.6, 0.2}, 0.8, 1)}, ball)},
        {"pane", brightScene({pane}, {slab}, ball)},
    };
    BrightScene room{"in a room", brightScene({glass}, {body}, ball)};
    room.scene.shapes.push_back({ShapeKind::kBox, {0, 4, 0}, {10, 0, 0}, {0, 10, 0}, {0, 0, 10}, 0});
    cases.push_back(room);
    // metal reflects light by its direction, which photons do not store
    BrightScene shiny{"on metal", brightScene({glass}, {body}, ball), false};
    shiny.scene.materials[0] = metal;
    cases.push_back(shiny);
    return cases;
}

class CausticScene : public testing::TestWithParam<std::size_t> {};

/// Compares the mean light of the picture and of its quarters with and without photons.
TEST_P(CausticScene, CountsAllLightOnce) {
    const BrightScene each = brightCases().at(GetParam());
    const auto all = [](Vec3) { return true; };
    const Film on = renderScene(each.scene, view(Integrator::kPath, 32)).film;
    const Film off = renderScene(each.scene, view(Integrator::kPath, 256, false)).film;
    const auto seen = regionMeans(on, on.rgba, 2, all), known = regionMeans(off, off.rgba, 2, all);
    const double total = sumOf(seen) / sumOf(known) - 1;
    const double share = sumOf(regionMeans(on, on.caustic, 1, all)) * 4 / sumOf(seen);
    double worst = 0;
    for (std::size_t part = 0; part < seen.size(); ++part)
        worst = std::max(worst, std::abs(seen[part] - known[part]) / sumOf(known) * 4);
    std::printf("%-26s %+.2f%% in all, %.2f%% in the worst quarter, caustics are %.1f%%\n", each.name, 100 * total,
                100 * worst, 100 * share);
    // counting caustics twice or not at all would exceed this
    if (each.gathers)
        EXPECT_GT(share, 0.001) << each.name;
    else
        EXPECT_EQ(share, 0) << each.name;
    EXPECT_LT(std::abs(total), each.gathers ? std::min(0.007, 0.5 * share) : 0.007) << each.name;
    EXPECT_LT(worst, 0.02) << each.name;
}

INSTANTIATE_TEST_SUITE_P(All, CausticScene, testing::Range(std::size_t{0}, brightCases().size()));

// Closed forms: straight down through level panes and slabs.

double lightUnder(SceneDescription scene, Integrator integrator, bool caustics = true) {
    RenderSettings settings = view(integrator, 4, caustics);
    settings.camera.eye = Vec3{2.5, kFloor + 0.9, 0};
    settings.camera.target = Vec3{0, kFloor, 0};
    settings.camera.up = Vec3{0, 1, 0};
    settings.camera.fov_deg = 8;
    scene.sky = evenSky(0);
    const Film film = renderScene(std::move(scene), settings).film;
    return pi * sumOf(regionMeans(film, film.rgba, 1, [](Vec3) { return true; })) / kDark;
}

/// A scene above a floor with negligible reflection.
SceneDescription under(const std::vector<MaterialDescription>& materials, const std::vector<ShapeDescription>& shapes,
                       const LightDescription& light) {
    SceneDescription scene = brightScene(materials, shapes, light);
    scene.materials[0] = material(MaterialKind::kMatte, kDark);
    return scene;
}

ShapeDescription paneAt(double height) { return floorAt(height, 2, 1); }

MaterialDescription thinGlass() {
    MaterialDescription glass = material(MaterialKind::kGlass);
    glass.thin = true;
    return glass;
}

/// Both sides of a pane together reflect 2 r / (1 + r), r = 0.04.
constexpr double kPaneReflects = 0.08 / 1.04;

TEST(Caustics, OfPanesUnderASun) {
    const SunLight sun{{0, 1, 0}, 0, grey(1)};
    const double one = 1 - kPaneReflects, two = one * one / (1 - kPaneReflects * kPaneReflects);
    for (const Integrator integrator : {Integrator::kPhong, Integrator::kWhitted, Integrator::kPath}) {
        EXPECT_NEAR(lightUnder(under({thinGlass()}, {paneAt(0)}, sun), integrator) / one, 1, 0.02);
        // one behind the other: light hits the upper one first, whichever of them photons are aimed at
        EXPECT_NEAR(lightUnder(under({thinGlass()}, {paneAt(0), paneAt(0.5)}, sun), integrator) / two, 1, 0.02);
        EXPECT_LT(lightUnder(under({thinGlass()}, {paneAt(0)}, sun), integrator, false), 0.002);
    }
}

TEST(Caustics, OfAPaneUnderAPoint) {
    // paths cannot hit a point light: only photons carry its light
    const double height = 5;
    const SceneDescription scene =
        under({thinGlass()}, {paneAt(0)}, PointLight{{0, kFloor + height, 0}, grey(height * height)});
    for (const Integrator integrator : {Integrator::kWhitted, Integrator::kPath}) {
        EXPECT_NEAR(lightUnder(scene, integrator) / (1 - kPaneReflects), 1, 0.02);
        EXPECT_LT(lightUnder(scene, integrator, false), 0.002);
    }
}

/// Irradiance of each pixel under a pane and a point light, relative to the exact value. The values hardly vary over
/// the floor.
std::vector<double> lightUnderAPane(std::uint32_t spp) {
    constexpr double kHeight = 40;
    SceneDescription scene =
        under({thinGlass()}, {paneAt(0)}, PointLight{{0, kFloor + kHeight, 0}, grey(kHeight * kHeight)});
    scene.sky = evenSky(0);
    RenderSettings settings = view(Integrator::kWhitted, spp);
    settings.width = 512; // so large that 16 samples share a map
    settings.height = 32;
    settings.camera.eye = Vec3{0.9, kFloor + 0.9, 0};
    settings.camera.target = Vec3{0, kFloor, 0};
    settings.camera.up = Vec3{0, 1, 0};
    settings.camera.fov_deg = 3;
    const Film film = renderScene(std::move(scene), settings).film;
    std::vector<double> light;
    for (std::size_t i = 0; i < film.samples.size(); ++i)
        light.push_back(pi * film.caustic[3 * i] / kDark / (1 - kPaneReflects));
    return light;
}

TEST(Caustics, ConvergeOverMaps) {
    const auto spread = [](const std::vector<double>& light) {
        const double mean = sumOf(light) / static_cast<double>(light.size());
        double squares = 0;
        for (const double each : light) squares += (each - mean) * (each - mean);
        return std::pair{mean, std::sqrt(squares / static_cast<double>(light.size()))};
    };
    const auto [mean, noise] = spread(lightUnderAPane(16));
    const auto [mean_of_4, noise_of_4] = spread(lightUnderAPane(4 * 16));
    std::printf("a map: %.4f +- %.4f, four: %.4f +- %.4f\n", mean, noise, mean_of_4, noise_of_4);
    EXPECT_NEAR(mean, 1, 0.02);
    EXPECT_NEAR(mean_of_4, 1, 0.005);
    // independent maps halve the noise, times 1.2 because discs shrink; equal maps would not reduce it
    EXPECT_LT(noise_of_4, 0.7 * noise);
}

TEST(Caustics, AreDimmedByAbsorption) {
    MaterialDescription clear = material(MaterialKind::kGlass);
    clear.index = 1;
    clear.absorption = {0.8f, 0.8f, 0.8f};
    const ShapeDescription slab{ShapeKind::kBox, {0, 0, 0}, {2, 0, 0}, {0, 0.5, 0}, {0, 0, 2}, 1};
    EXPECT_NEAR(lightUnder(under({clear}, {slab}, SunLight{{0, 1, 0}, 0, grey(1)}), Integrator::kWhitted),
                std::exp(-0.8), 0.01 * std::exp(-0.8));
}

TEST(Caustics, DoNotPassOpaqueShapes) {
    // a roof wider than the body's bounds hides the sun from it
    const SphereFile file(2000);
    SceneDescription scene = splatBody(file.path, material(MaterialKind::kGlass));
    scene.materials.push_back(material(MaterialKind::kMatte, 0.7f));
    scene.shapes = {floorAt(kFloor, 4, 1), floorAt(8, 20, 1)};
    scene.lights = {SunLight{{0, 1, 0}, 0, grey(1)}};
    const Film film = renderScene(scene, view(Integrator::kWhitted, 1)).film;
    EXPECT_EQ(sumOf(regionMeans(film, film.caustic, 1, [](Vec3) { return true; })), 0);
}

TEST(Caustics, OfTheLargestNumberOfInstances) {
    // the largest number of instances; only the last one is of glass
    const SphereFile file(200);
    SceneDescription scene = splatBody(file.path, material(MaterialKind::kGlass));
    scene.materials.push_back(material(MaterialKind::kMatte, 0.7f));
    scene.instances.clear();
    for (std::uint32_t i = 0; i < 254; ++i) {
        Placement at;
        at.scale = i < 253 ? 0.05 : 0.5;
        at.translation =
            i < 253 ? Vec3{0.2 * (i % 16) - 4, kFloor + 0.1, 0.2 * (i / 16) - 2} : Vec3{1, kFloor + 1.5, 0};
        scene.instances.push_back({file.path, at, i < 253 ? 1u : 0u, {}});
    }
    scene.shapes = {floorAt(kFloor, 4, 1)};
    scene.lights = {SunLight{{0, 1, 0}, 1, grey(1)}};
    RenderSettings settings = view(Integrator::kWhitted, 1);
    settings.bounces = 2;
    const Film film = renderScene(scene, settings).film;
    const auto lightWithin = [&](Vec3 center) {
        return sumOf(regionMeans(film, film.caustic, 1, [&](Vec3 at) {
            return std::hypot(at.x - center.x, at.z - center.z) < 0.5 && at.y < kFloor + 0.01;
        }));
    };
    EXPECT_GT(lightWithin({1, 0, 0}), 1e-4);
    EXPECT_LT(lightWithin({-3, 0, 2}), 1e-6);
}

} // namespace

} // namespace pointrt::test

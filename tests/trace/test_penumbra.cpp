// SPDX-License-Identifier: Apache-2.0
// Soft shadows of a straight edge: the part of the lamp that each point of the floor sees is known.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <numbers>
#include <string>
#include <vector>

#include "tests/support/splat_scenes.h"
#include "tests/trace/render_helper.h"

namespace pointrt::test {

namespace {

using std::numbers::pi;

// The floor is the plane y = 0. A blind, the half plane y = kEdge with x < 0, has its edge along z. The lamp's centre
// is at y = kLamp above the edge.
constexpr double kEdge = 4, kLamp = 12;
constexpr double kLampSize = 1; ///< radius, or half edge
constexpr double kHalfFloor = 3;

/// Irradiance of the floor by a spherical lamp of radiance 1 without the blind.
double sphereIrradiance(double x, double z) {
    const double squared = x * x + z * z + kLamp * kLamp;
    return pi * kLampSize * kLampSize / squared * kLamp / std::sqrt(squared);
}

/// Irradiance by the part of the spherical lamp that the blind leaves visible: from a point of the floor, the lamp is a
/// disc, which the plane through that point and the edge cuts in two.
double sphereBehindEdge(double x, double z) {
    const double distance = std::sqrt(x * x + z * z + kLamp * kLamp);
    // the plane through (x, 0, z) and the edge, with its normal towards the open side
    const Vec3 normal = normalize(Vec3{kEdge, x, 0}), to_lamp = Vec3{-x, kLamp, -z} * (1 / distance);
    const double s = std::clamp(dot(normal, to_lamp) * distance / kLampSize, -1.0, 1.0);
    return sphereIrradiance(x, z) * (std::acos(-s) + s * std::sqrt(1 - s * s)) / pi;
}

/// Irradiance at the origin by a rectangle [x0, x1] x [z0, z1] of radiance 1 at this height above it (Howell, A Catalog
/// of Radiation Heat Transfer Configuration Factors, B-4, for each corner).
double rectangleIrradiance(double x0, double x1, double z0, double z1, double height) {
    const auto corner = [&](double x, double z) {
        const double across = std::hypot(x, height), along = std::hypot(z, height);
        return 0.5 * (x / across * std::atan(z / across) + z / along * std::atan(x / along));
    };
    return corner(x1, z1) - corner(x0, z1) - corner(x1, z0) + corner(x0, z0);
}

double quadBehindEdge(double x, double z) {
    // seen from (x, 0), the edge at x = 0 hides the lamp up to here
    const double shadow = x - x * kLamp / kEdge;
    const double left = std::clamp(shadow, -kLampSize, kLampSize);
    return rectangleIrradiance(left - x, kLampSize - x, -kLampSize - z, kLampSize - z, kLamp);
}

/// Irradiance by the visible part of a disc lamp, which is summed over thin rectangles.
double discBehindEdge(double x, double z) {
    const double left = std::clamp(x - x * kLamp / kEdge, -kLampSize, kLampSize);
    const int strips = 200;
    const double width = (kLampSize - left) / strips;
    double sum = 0;
    for (int i = 0; i < strips; ++i) {
        const double at = left + (i + 0.5) * width, half = std::sqrt(kLampSize * kLampSize - at * at);
        sum += rectangleIrradiance(at - 0.5 * width - x, at + 0.5 * width - x, -half - z, half - z, kLamp);
    }
    return sum;
}

struct Floor {
    Floor() : path(temporaryPath("floor.pro")) {
        writeScene(path, squareSplats(150, Vec3f(0, 0, 0), Vec3f(0, 0, kHalfFloor), Vec3f(kHalfFloor, 0, 0), 1.2f), {});
    }
    ~Floor() { std::remove(path.c_str()); }
    Floor(const Floor&) = delete;
    Floor& operator=(const Floor&) = delete;
    std::string path;
};

/// The blind: black, so that it does not light the floor.
ShapeDescription shapeBlind() { return {ShapeKind::kQuad, {-20, kEdge, 0}, {20, 0, 0}, {0, 0, -20}, {0, 1, 0}, 1}; }

SceneDescription penumbraScene(const std::string& floor, const LightDescription& lamp) {
    MaterialDescription white, black;
    white.color = {1, 1, 1};
    black.color = {0, 0, 0};
    SceneDescription scene = splatBody(floor, white);
    scene.materials.push_back(black);
    scene.lights = {lamp};
    return scene;
}

struct Profile {
    double worst = 0; ///< largest difference in a stretch, relative to the irradiance by the whole lamp
    double total = 0; ///< relative difference of the sum of all stretches
};

/// Compares 20 stretches of the floor across the shadow's edge with the closed form.
Profile profileOf(SceneDescription scene, Integrator integrator, double (*expected)(double, double)) {
    RenderSettings settings = square(64);
    settings.camera.eye = Vec3{0, 3.5, 6};
    settings.camera.target = Vec3{0, 0, 0};
    settings.camera.fov_deg = 30;
    settings.integrator = integrator;
    settings.bounces = 2;
    settings.spp = 64;
    const Rendered rendered = renderScene(std::move(scene), settings);
    constexpr std::size_t kStretches = 20;
    const double half_width = 1.6;
    std::vector<double> seen(kStretches), known(kStretches);
    std::vector<std::size_t> pixels(kStretches);
    for (std::size_t i = 0; i < rendered.film.samples.size(); ++i) {
        const float* at = rendered.film.position.data() + 3 * i;
        if (rendered.film.rgba[4 * i + 3] < 1 || std::abs(at[0]) >= half_width) continue;
        const auto k = static_cast<std::size_t>((at[0] + half_width) / (2 * half_width) * kStretches);
        seen[k] += pi * rendered.film.rgba[4 * i];
        known[k] += expected(at[0], at[2]);
        ++pixels[k];
    }
    Profile profile;
    double seen_sum = 0, known_sum = 0;
    for (std::size_t k = 0; k < kStretches; ++k) {
        EXPECT_GT(pixels[k], 20u);
        profile.worst =
            std::max(profile.worst, std::abs(seen[k] - known[k]) / known[kStretches - 1] *
                                        static_cast<double>(pixels[kStretches - 1]) / static_cast<double>(pixels[k]));
        seen_sum += seen[k];
        known_sum += known[k];
    }
    profile.total = seen_sum / known_sum - 1;
    return profile;
}

struct PenumbraCase {
    const char* name;
    LightDescription lamp;
    double (*expected)(double, double);
};

std::vector<PenumbraCase> lamps() {
    const Color one{1, 1, 1};
    return {{"sphere", SphereLight{{0, kLamp, 0}, kLampSize, one}, sphereBehindEdge},
            {"quad", QuadLight{{0, kLamp, 0}, {kLampSize, 0, 0}, {0, 0, kLampSize}, one}, quadBehindEdge},
            {"disc", DiscLight{{0, kLamp, 0}, {0, -1, 0}, kLampSize, one}, discBehindEdge}};
}

void checkProfile(const char* blind, const PenumbraCase& each, const SceneDescription& scene) {
    for (const Integrator integrator : {Integrator::kWhitted, Integrator::kPath}) {
        const Profile p = profileOf(scene, integrator, each.expected);
        std::printf("%s lamp, blind of %s, %s: worst %.2f%% of full light, sum %+.2f%%\n", each.name, blind,
                    integrator == Integrator::kPath ? "path" : "whitted", 100 * p.worst, 100 * p.total);
        EXPECT_LT(p.worst, 0.008);
        EXPECT_LT(std::abs(p.total), 0.005);
    }
}

TEST(Penumbra, OfAShapeMatchesTheClosedForm) {
    const Floor floor;
    for (const PenumbraCase& each : lamps()) {
        SceneDescription scene = penumbraScene(floor.path, each.lamp);
        scene.shapes.push_back(shapeBlind());
        checkProfile("shapes", each, scene);
    }
}

TEST(Penumbra, OfSplatsMatchesTheClosedForm) {
    const Floor floor;
    const std::string path = temporaryPath("blind.pro");
    const std::size_t side = 400;
    const float half = 4, spacing = 2 * half / static_cast<float>(side), radius = 1.2f * spacing;
    // the rim is scalloped: circles of that radius, a spacing apart, extend this far beyond their centres on average
    double reach = 0;
    const int steps = 1000;
    for (int i = 0; i < steps; ++i) {
        const double across = spacing * ((i + 0.5) / steps - 0.5);
        reach += std::sqrt(radius * radius - across * across) / steps;
    }
    const auto middle = static_cast<float>(-half + 0.5 * spacing - reach);
    writeScene(path, squareSplats(side, Vec3f(middle, kEdge, 0), Vec3f(0, 0, half), Vec3f(half, 0, 0), 1.2f), {});
    for (const PenumbraCase& each : lamps()) {
        SceneDescription scene = penumbraScene(floor.path, each.lamp);
        scene.instances.push_back({path, {}, 1u, {}});
        checkProfile("splats", each, scene);
    }
    std::remove(path.c_str());
}

} // namespace

} // namespace pointrt::test

// SPDX-License-Identifier: Apache-2.0
// Light at grazing angles on noisy scans: a plane is evenly lit, and objects above it still cast shadows.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <numbers>
#include <random>
#include <string>
#include <vector>

#include "tests/support/splat_scenes.h"
#include "tests/trace/render_helper.h"

namespace pointrt::test {

namespace {

constexpr double kElevation = 10; ///< degrees, of the sun
constexpr std::size_t kSide = 120;
constexpr float kSpacing = 2.0f / kSide,
                kRadius = 1.5f * kSpacing; ///< about as estimated by the bake for evenly sampled clouds

/// The square [-1, 1]^2 with normals along z, whose splats are displaced by Gaussian noise of sigma spacings. The noise
/// is in the file if `stored`.
Splats noisyPlane(float sigma, bool stored) {
    Splats splats = squareSplats(kSide, Vec3f(0, 0, 0), Vec3f(1, 0, 0), Vec3f(0, 1, 0), kRadius / kSpacing);
    std::mt19937 random(5);
    std::normal_distribution<float> gauss(0, sigma * kSpacing);
    for (Vec3f& position : splats.positions) position.z() += gauss(random);
    if (stored) splats.noise.assign(splats.positions.size(), sigma * kSpacing);
    return splats;
}

/// A white scene under a sun, seen from above the middle.
Film litFromThere(Splats splats, Vec3 towards, Integrator integrator) {
    const std::string path = temporaryPath("noisy.pro");
    writeScene(path, std::move(splats), {});
    MaterialDescription white;
    white.color = {1, 1, 1};
    SceneDescription scene = splatBody(path, white);
    scene.lights = {SunLight{normalize(towards), 0, {1, 1, 1}}};
    RenderSettings settings = square(128);
    settings.camera.eye = Vec3{0, 0, 6};
    settings.camera.target = Vec3{0, 0, 0};
    settings.camera.up = Vec3{0, 1, 0};
    settings.camera.fov_deg = 2 * std::atan(0.6 / 6) * 180 / std::numbers::pi;
    settings.integrator = integrator;
    settings.bounces = 0;
    settings.caustics = false;
    Film film = renderScene(std::move(scene), settings).film;
    std::remove(path.c_str());
    return film;
}

struct Evenness {
    double mean = 0, deviation = 0; ///< relative to an even plane
    double dark = 0;                ///< share of pixels below half of that
};

Evenness evennessOf(const Film& film, double expected) {
    Evenness result;
    const std::size_t pixels = film.rgba.size() / 4;
    double squared = 0;
    for (std::size_t i = 0; i < pixels; ++i) {
        const double value = double{film.rgba[4 * i]} / expected;
        result.mean += value / static_cast<double>(pixels);
        squared += value * value / static_cast<double>(pixels);
        result.dark += value < 0.5 ? 1.0 / static_cast<double>(pixels) : 0;
    }
    result.deviation = std::sqrt(std::max(0.0, squared - result.mean * result.mean));
    return result;
}

Vec3 lowSun() {
    const double angle = kElevation * std::numbers::pi / 180;
    return {std::cos(angle) * 0.8, std::cos(angle) * 0.6, std::sin(angle)};
}

/// With known normals the plane should be as bright as an exact one.
Evenness litPlane(float sigma, bool stored) {
    const double expected = std::sin(kElevation * std::numbers::pi / 180) / std::numbers::pi;
    const Evenness lit = evennessOf(litFromThere(noisyPlane(sigma, stored), lowSun(), Integrator::kPath), expected);
    std::printf("noise of %.1f spacings, %s: mean %.4f, deviation %.4f, dark %.5f\n", double{sigma},
                stored ? "stored" : "not stored", lit.mean, lit.deviation, lit.dark);
    return lit;
}

TEST(Noise, PlanesUnderALowSunAreEvenlyLit) {
    for (const float sigma : {0.2f, 0.4f, 0.7f, 1.0f}) {
        const Evenness lit = litPlane(sigma, true);
        EXPECT_NEAR(lit.mean, 1, 0.004) << sigma; // stored normals are 0.04 degrees off, at a slope of tan 80 degrees
        EXPECT_LT(lit.deviation, 0.005) << sigma;
        EXPECT_EQ(lit.dark, 0) << sigma;
    }
}

TEST(Noise, EvenLightNeedsTheNoiseOfTheFile) {
    EXPECT_GT(litPlane(1.0f, false).dark, 0.004) << "else the noise would not matter";
}

/// A ball of ten radii, with its lowest point height radii above the middle of the plane.
Splats withBall(Splats plane, float height, bool oriented) {
    const float size = 10 * kRadius;
    Splats ball = sphereSplats(4000, Vec3f(0, 0, size + height * kRadius), size);
    ball.noise.assign(plane.noise.empty() ? 0 : ball.positions.size(), plane.noise.empty() ? 0 : plane.noise[0]);
    Splats both = joinSplats(plane, ball);
    both.noise = plane.noise;
    both.noise.insert(both.noise.end(), ball.noise.begin(), ball.noise.end());
    both.oriented = oriented;
    return both;
}

/// The share of visible points straight under the ball, seen from the side, that a sun overhead reaches.
double litUnderTheBall(float sigma, bool oriented) {
    Splats scene = withBall(noisyPlane(sigma, true), 6, oriented);
    const std::string path = temporaryPath("ball.pro");
    writeScene(path, std::move(scene), {});
    MaterialDescription white;
    SceneDescription described = splatBody(path, white);
    described.lights = {SunLight{{0, 0, 1}, 0, {1, 1, 1}}};
    RenderSettings settings = square(64);
    settings.camera.eye = Vec3{0, -3, 1.2};
    settings.camera.target = Vec3{0, 0, 0};
    settings.camera.up = Vec3{0, 0, 1};
    settings.camera.fov_deg = 20;
    settings.integrator = Integrator::kPath;
    settings.bounces = 0;
    settings.caustics = false;
    const Film film = renderScene(std::move(described), settings).film;
    std::remove(path.c_str());
    std::size_t seen = 0, lit = 0;
    for (std::size_t i = 0; i < film.samples.size(); ++i) {
        const float* at = film.position.data() + 3 * i;
        const bool under = std::hypot(at[0], at[1]) < 8 * kRadius && std::abs(at[2]) < 5 * sigma * kSpacing + kRadius;
        if (!under || !std::isfinite(film.depth[i])) continue;
        ++seen;
        lit += film.rgba[4 * i] > 0.01f;
    }
    EXPECT_GT(seen, 20u);
    return static_cast<double>(lit) / static_cast<double>(seen);
}

TEST(Noise, ShadowsFromSixRadiiAboveRemain) {
    for (const bool oriented : {true, false})
        for (const float sigma : {0.3f, 1.0f}) EXPECT_EQ(litUnderTheBall(sigma, oriented), 0) << sigma << oriented;
}

} // namespace

} // namespace pointrt::test

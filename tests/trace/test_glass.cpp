// SPDX-License-Identifier: Apache-2.0
// A glass ball of splats, compared with the analytic one: the directions of light through it, and the picture in it.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "tests/trace/render_helper.h"

namespace pointrt::test {

namespace {

constexpr std::uint32_t kGlassSize = 384;
constexpr double kIndex = 1.5;

MaterialDescription clearGlass() {
    MaterialDescription glass;
    glass.kind = MaterialKind::kGlass;
    glass.color = {1, 1, 1};
    glass.index = static_cast<float>(kIndex);
    return glass;
}

RenderSettings lookAtBall(Integrator integrator) {
    RenderSettings settings = square(kGlassSize);
    settings.camera.eye = Vec3{0.5, 1, 4};
    settings.camera.target = Vec3{0, 0, 0};
    settings.camera.fov_deg = 30;
    settings.integrator = integrator;
    settings.bounces = 16;
    return settings;
}

/// Directions of light from the unit ball at the origin: reflected outside, or transmitted after zero, one or two
/// reflections inside.
std::optional<std::array<Vec3, 4>> exactWays(Vec3 eye, Vec3 d) {
    const double along = -dot(eye, d), squared = along * along - dot(eye, eye) + 1;
    if (squared < 0) return std::nullopt;
    const Vec3 n = eye + (along - std::sqrt(squared)) * d;
    std::array<Vec3, 4> ways{d - 2 * dot(d, n) * n};
    const double cosine = -dot(n, d), behind = std::sqrt(1 - (1 - cosine * cosine) / (kIndex * kIndex));
    Vec3 inside = (1 / kIndex) * d + (cosine / kIndex - behind) * n, at = n;
    for (std::size_t way = 1; way < ways.size(); ++way) {
        at = at + 2 * behind * inside;
        ways[way] = kIndex * inside - (kIndex * behind - cosine) * at;
        inside = inside - 2 * behind * at;
    }
    return ways;
}

struct WayErrors {
    std::vector<double> errors; ///< degrees, of light that crossed the ball
    std::size_t other = 0;      ///< pixels whose path is none of the exact ones
    std::size_t pixels = 0;
};

/// One path per pixel, each with a single way through the ball.
WayErrors wayErrors(SceneDescription scene, const std::string& sky) {
    scene.sky->image = sky;
    const RenderSettings settings = lookAtBall(Integrator::kPath);
    const Rendered rendered = renderScene(std::move(scene), settings);
    WayErrors result;
    for (std::uint32_t y = 0; y < kGlassSize; ++y)
        for (std::uint32_t x = 0; x < kGlassSize; ++x) {
            const std::size_t i = std::size_t{y} * kGlassSize + x;
            const auto ways = exactWays(rendered.camera.eye, centerRayDirection(settings, rendered.camera, x, y));
            if (!ways || !std::isfinite(rendered.film.depth[i])) continue;
            const Vec3 seen = colorDirection(rendered.film, i);
            std::array<double, 4> errors{};
            for (std::size_t way = 0; way < ways->size(); ++way) errors[way] = angleBetween(seen, (*ways)[way]);
            const auto nearest = std::min_element(errors.begin(), errors.end());
            ++result.pixels;
            result.other += *nearest > 10;
            // light that took another path is not compared
            if (nearest == errors.begin() + 1 && *nearest <= 10) result.errors.push_back(*nearest);
        }
    return result;
}

TEST(Glass, LightLeavesTheBallBySnellsLaw) {
    const std::string sky = writeSky("directions.exr", 512, directionColor);
    const WayErrors shape = wayErrors(analyticSphere(clearGlass()), sky);
    const Spread exact = spreadOf(shape.errors);
    std::printf("shape: mean %.5f, p99 %.5f, largest %.4f degrees, %zu of %zu pixels cross, %zu unexplained\n",
                exact.mean, exact.p99, exact.largest, shape.errors.size(), shape.pixels, shape.other);
    EXPECT_LT(exact.p99, 0.02);
    EXPECT_GT(shape.errors.size(), shape.pixels * 8 / 10);
    // degrees, 1.5 times what was measured
    struct RefractionLimits {
        std::size_t splats;
        double mean, p99;
    };
    for (const RefractionLimits& each :
         {RefractionLimits{20000, 0.48, 3}, RefractionLimits{100000, 0.22, 1.35}, RefractionLimits{500000, 0.1, 0.6}}) {
        const SphereFile file(each.splats);
        const WayErrors found = wayErrors(splatBody(file.path, clearGlass()), sky);
        const Spread spread = spreadOf(found.errors);
        std::printf("%zu splats: mean %.4f, median %.4f, p99 %.4f, largest %.3f degrees, %zu of %zu cross, %zu "
                    "unexplained\n",
                    each.splats, spread.mean, spread.median, spread.p99, spread.largest, found.errors.size(),
                    found.pixels, found.other);
        EXPECT_LT(spread.mean, each.mean);
        EXPECT_LT(spread.p99, each.p99);
        EXPECT_LE(found.other, shape.other);
    }
    std::remove(sky.c_str());
}

TEST(Glass, ShowsThePictureBehindTheBall) {
    // bands of light of 20 degrees, seen through splats and through the analytic ball
    const std::string sky = writeSky("bands.exr", 512, [](Vec3 d) {
        const auto wave = [](double v) { return static_cast<float>(0.5 + 0.5 * std::sin(18 * v)); };
        return Color{wave(std::atan2(d.x, -d.z)), wave(std::asin(d.y)), 0.5f};
    });
    const auto render = [&](SceneDescription scene) {
        scene.sky->image = sky;
        RenderSettings settings = lookAtBall(Integrator::kWhitted);
        settings.spp = 4;
        return renderScene(std::move(scene), settings).film;
    };
    const SphereFile file(100000);
    const Film shape = render(analyticSphere(clearGlass())), splats = render(splatBody(file.path, clearGlass()));
    std::remove(sky.c_str());
    double sum = 0, signed_sum = 0, light = 0;
    std::size_t pixels = 0;
    for (std::size_t i = 0; i < shape.samples.size(); ++i) {
        if (shape.rgba[4 * i + 3] < 1 || splats.rgba[4 * i + 3] < 1) continue;
        for (std::size_t c = 0; c < 2; ++c) {
            const double difference = splats.rgba[4 * i + c] - shape.rgba[4 * i + c];
            sum += difference * difference;
            signed_sum += difference;
            light += shape.rgba[4 * i + c];
        }
        ++pixels;
    }
    const double rms = std::sqrt(sum / (2.0 * static_cast<double>(pixels)));
    std::printf("%zu pixels, rms difference %.4f, light %+.3f%%\n", pixels, rms, 100 * signed_sum / light);
    EXPECT_GT(pixels, kGlassSize * kGlassSize / 3);
    EXPECT_LT(rms, 0.03);
    EXPECT_LT(std::abs(signed_sum), 0.002 * light);
}

/// A wall of glass of a scan, across the view.
struct GlassWall {
    float z;
    bool faces_eye; ///< whether its outer side does
};

/// The light of an even sky of radiance 1 through walls between glass that absorbs, but does not bend light.
/// shapes: of clear glass.
double lightThrough(const std::vector<GlassWall>& walls, float absorption, Integrator integrator,
                    std::vector<ShapeDescription> shapes = {}) {
    Splats splats;
    splats.oriented = true;
    for (const GlassWall& wall : walls) {
        const Vec3f v{0, wall.faces_eye ? 1.0f : -1.0f, 0};
        splats = joinSplats(std::move(splats), squareSplats(48, {0, 0, wall.z}, {1, 0, 0}, v));
    }
    const std::string path = temporaryPath("walls.pro");
    writeScene(path, std::move(splats), {});
    MaterialDescription glass = clearGlass();
    glass.index = 1;
    glass.absorption = {absorption, absorption, absorption};
    SceneDescription scene = splatBody(path, glass);
    scene.materials.push_back(clearGlass());
    scene.materials.back().index = 1;
    for (ShapeDescription& shape : shapes) shape.material = static_cast<std::uint32_t>(scene.materials.size() - 1);
    scene.shapes = std::move(shapes);
    scene.sky = evenSky(1);
    RenderSettings settings = square(8);
    settings.camera.eye = Vec3{0, 0, 3};
    settings.camera.target = Vec3{0, 0, 0};
    settings.camera.fov_deg = 1;
    settings.integrator = integrator;
    settings.bounces = 8;
    const Film film = renderScene(std::move(scene), settings).film;
    std::remove(path.c_str());
    return film.rgba[4 * (4 * 8 + 4)];
}

TEST(Glass, AbsorbsOnlyOnTheWayFromWhereLightEntered) {
    constexpr GlassWall kFront{0.25f, true}, kBack{-0.25f, false};
    constexpr float kAbsorption = 2;
    constexpr double kTolerance = 0.01; // rays start a quarter of a radius, 0.01, from their surface
    const double slab = std::exp(-0.5 * kAbsorption);
    for (const Integrator integrator : {Integrator::kPath, Integrator::kWhitted}) {
        const auto light = [&](const std::vector<GlassWall>& walls) {
            return lightThrough(walls, kAbsorption, integrator);
        };
        EXPECT_NEAR(light({kFront, kBack}), slab, kTolerance);
        EXPECT_NEAR(light({kBack}), 1, kTolerance) << "the front has a hole";
        EXPECT_NEAR(light({kFront}), 1, kTolerance) << "the back has a hole";
        EXPECT_NEAR(light({kFront, kBack, {-1, false}}), slab, kTolerance) << "the front of what is behind has a hole";
        EXPECT_NEAR(light({{1, true}, kFront, kBack}), slab, kTolerance) << "the back of what is in front has a hole";
    }
    // Light that has left a box in the slab has not left the slab. The path integrator ends some paths after three
    // surfaces.
    const ShapeDescription box{ShapeKind::kBox, {0, 0, 0}, {0.1, 0, 0}, {0, 0.1, 0}, {0, 0, 0.1}};
    EXPECT_NEAR(lightThrough({kFront, kBack}, kAbsorption, Integrator::kWhitted, {box}),
                std::exp(-kAbsorption * (0.25 - 0.1)), kTolerance);
}

} // namespace

} // namespace pointrt::test

// SPDX-License-Identifier: Apache-2.0
// A mirror ball of splats reflects like the analytic one. The colours of the sky encode directions.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <optional>
#include <string>

#include "tests/trace/render_helper.h"

namespace pointrt::test {

namespace {

constexpr std::uint32_t kMirrorSize = 384;

/// The direction in which the unit sphere around the origin reflects the ray through a pixel's centre.
std::optional<Vec3> exactReflection(const RenderSettings& settings, const Camera& camera, std::uint32_t x,
                                    std::uint32_t y) {
    const Vec3 d = centerRayDirection(settings, camera, x, y);
    const double along = -dot(camera.eye, d), squared = along * along - dot(camera.eye, camera.eye) + 1;
    if (squared < 0) return std::nullopt;
    const Vec3 n = camera.eye + (along - std::sqrt(squared)) * d;
    return d - 2 * dot(d, n) * n;
}

/// Degrees between rendered and exact directions, over all pixels of the ball.
Spread reflectionErrors(SceneDescription scene, const std::string& sky) {
    scene.sky->image = sky;
    RenderSettings settings = square(kMirrorSize);
    settings.camera.eye = Vec3{0.5, 1, 4};
    settings.camera.target = Vec3{0, 0, 0};
    settings.camera.fov_deg = 30;
    settings.integrator = Integrator::kWhitted;
    settings.bounces = 4;
    const Rendered rendered = renderScene(std::move(scene), settings);
    std::vector<double> errors;
    for (std::uint32_t y = 0; y < kMirrorSize; ++y)
        for (std::uint32_t x = 0; x < kMirrorSize; ++x) {
            const std::size_t i = std::size_t{y} * kMirrorSize + x;
            const auto exact = exactReflection(settings, rendered.camera, x, y);
            if (!exact || !std::isfinite(rendered.film.depth[i])) continue;
            errors.push_back(angleBetween(colorDirection(rendered.film, i), *exact));
        }
    EXPECT_GT(errors.size(), kMirrorSize * kMirrorSize / 3);
    return spreadOf(std::move(errors));
}

/// The number of secondary rays from a ball under an even sky.
std::uint64_t secondaryRaysOf(Integrator integrator, const MaterialDescription& material) {
    SceneDescription scene = analyticSphere(material);
    scene.sky = evenSky(1);
    RenderSettings settings = square(32);
    settings.integrator = integrator;
    return renderScene(std::move(scene), settings).rays.secondary;
}

// Programs and passes for secondary rays exist only if the integrator has such rays from one of the materials.
TEST(Mirror, SecondaryRaysLeaveMirrorsOnly) {
    MaterialDescription matte, share, highlight, metal;
    share.mirror_share = 0.25f;
    highlight.specular = 0.5f;
    metal.kind = MaterialKind::kMetal;
    for (const MaterialDescription& each : {matte, share, highlight, metal}) {
        EXPECT_GT(secondaryRaysOf(Integrator::kPath, each), 0u);
        EXPECT_EQ(secondaryRaysOf(Integrator::kNormal, each), 0u);
    }
    for (const Integrator classic : {Integrator::kPhong, Integrator::kWhitted}) {
        EXPECT_EQ(secondaryRaysOf(classic, matte), 0u);
        EXPECT_GT(secondaryRaysOf(classic, share), 0u);
        EXPECT_GT(secondaryRaysOf(classic, metal), 0u);
    }
    EXPECT_EQ(secondaryRaysOf(Integrator::kPhong, highlight), 0u);
    EXPECT_GT(secondaryRaysOf(Integrator::kWhitted, highlight), 0u);
}

TEST(Mirror, ReflectsAsTheAnalyticBall) {
    MaterialDescription mirror;
    mirror.kind = MaterialKind::kMirror;
    mirror.color = {1, 1, 1};
    const std::string sky = writeSky("directions.exr", 512, directionColor);
    const Spread shape = reflectionErrors(analyticSphere(mirror), sky);
    std::printf("shape: mean %.5f, p99 %.5f, largest %.4f degrees\n", shape.mean, shape.p99, shape.largest);
    EXPECT_LT(shape.p99, 0.01);
    // degrees, 1.5 times what was measured; a splat's radius is 1.7, 0.77 and 0.34 degrees of arc
    struct NormalErrorLimits {
        std::size_t splats;
        double mean, p99;
    };
    for (const NormalErrorLimits& each : {NormalErrorLimits{20000, 0.14, 0.37}, NormalErrorLimits{100000, 0.065, 0.17},
                                          NormalErrorLimits{500000, 0.04, 0.1}}) {
        const SphereFile file(each.splats);
        const Spread spread = reflectionErrors(splatBody(file.path, mirror), sky);
        std::printf("%zu splats: mean %.4f, median %.4f, p99 %.4f, largest %.3f degrees\n", each.splats, spread.mean,
                    spread.median, spread.p99, spread.largest);
        EXPECT_LT(spread.mean, each.mean);
        EXPECT_LT(spread.p99, each.p99);
    }
    std::remove(sky.c_str());
}

} // namespace

} // namespace pointrt::test

// SPDX-License-Identifier: Apache-2.0
// Discs that stick out over a body's outline are hit from behind there: they count as the front that covers them. Real
// backs remain backs.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <random>
#include <string>
#include <utility>
#include <vector>

#include "pointrt/pro.hpp"
#include "tests/support/ray_caster.h"
#include "tests/support/splat_scenes.h"
#include "tests/trace/render_helper.h"

namespace pointrt::test {

namespace {

/// A unit sphere whose splats are displaced by Gaussian noise of that many radii, and normals by as many radians.
Splats roughBall(float noise) {
    Splats splats = sphereSplats(20000, Vec3f(0, 0, 0), 1.0f, 1.5f);
    std::mt19937 random(3);
    std::normal_distribution<float> gauss(0, noise);
    for (std::size_t i = 0; i < splats.positions.size(); ++i) {
        splats.positions[i] += gauss(random) * splats.radii[i] * splats.normals[i];
        const Vec3f tilt(gauss(random), gauss(random), gauss(random));
        splats.normals[i] = (splats.normals[i] + tilt).normalized();
    }
    return splats;
}

/// Hits of camera rays from afar.
struct Seen {
    std::vector<Ray> rays;
    std::vector<CastHit> hits;
    pro_info info{};
    Vec3 at(std::size_t i) const { ///< input coordinates
        const Vec3 cube = rays[i].origin + hits[i].t_blended * rays[i].direction;
        return Vec3{info.origin[0], info.origin[1], info.origin[2]} + info.scale * cube;
    }
};

Seen lookAt(const Splats& splats, Vec3 eye) {
    const std::string path = temporaryPath("rims.pro");
    writeScene(path, splats, {});
    RayCaster caster(path);
    CameraRequest camera;
    camera.eye = eye;
    camera.target = Vec3{0, 0, 0};
    camera.fov_deg = 30;
    Seen seen;
    seen.rays = caster.cameraRays(256, camera);
    seen.hits = caster.cast(seen.rays);
    seen.info = ProFile(path).info();
    std::remove(path.c_str());
    return seen;
}

/// Some discs remain backs if they are displaced by more than the thickness of their neighbours' slabs.
TEST(Rims, ClosedBodiesHaveNoVisibleBacks) {
    constexpr std::pair<float, double> kMost[] = {{0.0f, 0}, {0.05f, 5e-4}, {0.1f, 5e-4}, {0.25f, 0.01}};
    for (const auto& [noise, most] : kMost) {
        const Splats ball = roughBall(noise);
        const Seen seen = lookAt(ball, {1, 2, 4});
        std::size_t hits = 0, behind = 0, backs = 0;
        for (std::size_t i = 0; i < seen.hits.size(); ++i) {
            if (!seen.hits[i].hit()) continue;
            ++hits;
            backs += seen.hits[i].back;
            EXPECT_LT(dot(seen.hits[i].normal, seen.rays[i].direction), 0);
            // the lit side must be the body's outside
            behind += dot(seen.hits[i].normal, normalize(seen.at(i))) < 0;
        }
        std::printf("noise %.2f: %zu hits, %zu backs, %zu turned inwards\n", double{noise}, hits, backs, behind);
        EXPECT_GT(hits, 20000u);
        EXPECT_LE(static_cast<double>(backs), most * static_cast<double>(hits)) << noise;
        EXPECT_LE(static_cast<double>(behind), most * static_cast<double>(hits)) << noise;
    }
}

/// A sun from the right fully lights the right rim of the ball, where normals are within 20 degrees of its direction.
TEST(Rims, OutlinesAreLitLikeFronts) {
    const std::string path = temporaryPath("lit.pro");
    writeScene(path, roughBall(0.05f), {});
    MaterialDescription white;
    white.color = {1, 1, 1};
    SceneDescription scene = splatBody(path, white);
    scene.lights = {SunLight{{1, 0, 0}, 0, {1, 1, 1}}};
    RenderSettings settings = square(512);
    settings.camera.eye = Vec3{0, 0, 6};
    settings.camera.target = Vec3{0, 0, 0};
    settings.camera.fov_deg = 22;
    settings.integrator = Integrator::kPath;
    settings.bounces = 0;
    const Film film = renderScene(std::move(scene), settings).film;
    std::remove(path.c_str());
    std::size_t rim = 0, dark = 0;
    for (std::size_t i = 0; i < film.depth.size(); ++i) {
        if (!std::isfinite(film.depth[i])) continue;
        const float* at = film.position.data() + 3 * i;
        if (at[0] < 0.94 * std::hypot(at[0], at[1], at[2]) || std::abs(at[2]) > 0.3f) continue;
        ++rim;
        dark += film.rgba[4 * i] < 0.5f / 3.14159f;
    }
    std::printf("%zu of %zu pixels of the lit rim are dark\n", dark, rim);
    EXPECT_GT(rim, 300u);
    EXPECT_EQ(dark, 0u);
}

TEST(Rims, InsidesOfBowlsRemainBacks) {
    Splats bowl = sphereSplats(20000, Vec3f(0, 0, 0), 1.0f, 1.5f);
    Splats lower = bowl;
    lower.positions.clear(), lower.normals.clear(), lower.radii.clear(), lower.input_index.clear();
    for (std::size_t i = 0; i < bowl.positions.size(); ++i) {
        if (bowl.positions[i].z() > 0) continue;
        lower.input_index.push_back(static_cast<std::uint32_t>(lower.positions.size()));
        lower.positions.push_back(bowl.positions[i]);
        lower.normals.push_back(bowl.normals[i]);
        lower.radii.push_back(bowl.radii[i]);
    }
    const double radius = double{bowl.radii[0]};
    const Seen seen = lookAt(lower, {0.5, 1, 4});
    std::size_t inside = 0, wrong = 0;
    for (std::size_t i = 0; i < seen.hits.size(); ++i) {
        if (!seen.hits[i].hit()) continue;
        const Vec3 at = seen.at(i);
        if (at.z > -2 * radius || dot(at, seen.rays[i].direction) < 2 * radius) continue; // its outline
        ++inside;
        wrong += !seen.hits[i].back || dot(seen.hits[i].normal, normalize(at)) > -0.99;
    }
    EXPECT_GT(inside, 15000u);
    EXPECT_EQ(wrong, 0u);
}

/// A sheet scanned from both sides, three spacings thick; the upper side has an opening.
TEST(Rims, FarSidesOfThinSheetsRemainBacks) {
    constexpr std::size_t kPointsAlongEdge = 100;
    const float spacing = 2.0f / kPointsAlongEdge, thick = 3 * spacing, factor = 1.5f;
    const Splats top = squareSplats(kPointsAlongEdge, Vec3f(0, 0, thick), Vec3f(1, 0, 0), Vec3f(0, 1, 0), factor);
    Splats sheet = squareSplats(kPointsAlongEdge, Vec3f(0, 0, 0), Vec3f(0, 1, 0), Vec3f(1, 0, 0), factor);
    for (std::size_t i = 0; i < top.positions.size(); ++i) {
        if (std::abs(top.positions[i].x()) < 0.5f && std::abs(top.positions[i].y()) < 0.5f) continue;
        sheet.input_index.push_back(static_cast<std::uint32_t>(sheet.positions.size()));
        sheet.positions.push_back(top.positions[i]);
        sheet.normals.push_back(top.normals[i]);
        sheet.radii.push_back(top.radii[i]);
    }
    const Seen seen = lookAt(sheet, {0.3, 0.5, 5});
    std::size_t through = 0, wrong = 0, above = 0;
    for (std::size_t i = 0; i < seen.hits.size(); ++i) {
        if (!seen.hits[i].hit()) continue;
        const Vec3 at = seen.at(i);
        const bool low = at.z < 0.5 * double{thick};
        const bool inside = std::abs(at.x) < 0.9 && std::abs(at.y) < 0.9;
        if (!inside) continue;
        (low ? through : above) += 1;
        wrong += seen.hits[i].back != low || seen.hits[i].normal.z < 0.99;
    }
    EXPECT_GT(through, 3000u);
    EXPECT_GT(above, 3000u);
    EXPECT_EQ(wrong, 0u);
}

} // namespace

} // namespace pointrt::test

// SPDX-License-Identifier: Apache-2.0
// The blended surface, compared with a sum over all splats, where rays reach it outside the cell of their first hit.
#include <gtest/gtest.h>

#include "pointrt/pro.hpp"
#include "tests/support/ray_caster.h"
#include "tests/support/rays.h"
#include "tests/support/splat_scenes.h"
#include "tests/trace/reference.h"
#include <cstdio>

namespace pointrt::test {

namespace {

/// A sphere whose splats are up to a fifth of a radius inside or outside, so that first hits are off the blended
/// surface.
Splats roughSphere(float radius_factor) {
    Splats splats = sphereSplats(3000, Vec3f(0, 0, 0), 1.0f, radius_factor);
    unsigned state = 7;
    for (std::size_t i = 0; i < splats.positions.size(); ++i) {
        state = state * 1664525u + 1013904223u;
        splats.positions[i] *= 1.0f + 0.2f * splats.radii[i] * (static_cast<float>(state >> 8) / 0x1p23f - 1.0f);
    }
    return splats;
}

pro_info infoOf(const std::string& path) {
    const ProFile file(path);
    return file.info();
}

/// The share of hits whose blended surface is more than 0.01 radii from that of all splats.
double shareOff(const Splats& scene) {
    const std::string path = temporaryPath("rough.pro");
    writeScene(path, scene, {});
    const std::vector<CubeSplat> splats = loadCubeSplats(path);
    constexpr std::size_t ray_count = 3000;
    const std::vector<Ray> rays = grazingRays(splats, ray_count, 3);
    const std::vector<CastHit> hits = RayCaster(path).cast(rays);
    const Reference reference = loadReference(path);
    const pro_info info = infoOf(path);
    std::remove(path.c_str());

    const Vec3 corner{info.origin[0], info.origin[1], info.origin[2]};
    std::size_t compared = 0, off = 0;
    for (std::size_t i = 0; i < rays.size(); ++i) {
        const auto expected = firstSurface(reference, corner + info.scale * rays[i].origin, rays[i].direction);
        if (!expected || !hits[i].hit() || splats.size() <= hits[i].splat || expected->splat != hits[i].splat) continue;
        ++compared;
        const double radius = splats[hits[i].splat].radius;
        off += std::abs(hits[i].t_blended - expected->t / info.scale) > 0.01 * radius;
    }
    EXPECT_GT(compared, ray_count * 9 / 10);
    return static_cast<double>(off) / static_cast<double>(compared);
}

/// The share of rays nearly parallel to the field, where rounding decides.
constexpr double kRounding = 1e-3;

TEST(Field, IsEvaluatedInTheCellOfThePoint) { EXPECT_LE(shareOff(roughSphere(1.6f)), kRounding); }

TEST(Field, IsCompletedByTheDiscWhereWeightsAreLow) { EXPECT_LE(shareOff(roughSphere(0.6f)), kRounding); }

TEST(Field, IsTheDiscForDiffusedRays) {
    const std::string path = temporaryPath("diffused.pro");
    writeScene(path, roughSphere(1.6f), {});
    const std::vector<CubeSplat> splats = loadCubeSplats(path);
    std::vector<Ray> rays = grazingRays(splats, 1000, 3);
    RayCaster caster(path);
    const std::vector<CastHit> direct = caster.cast(rays);
    for (Ray& ray : rays) ray.diffused = true;
    const std::vector<CastHit> diffused = caster.cast(rays);
    std::remove(path.c_str());

    std::size_t hits = 0, apart = 0, of_the_disc = 0;
    for (std::size_t i = 0; i < rays.size(); ++i) {
        if (!direct[i].hit()) continue;
        ++hits;
        ASSERT_EQ(diffused[i].splat, direct[i].splat);
        EXPECT_FLOAT_EQ(static_cast<float>(diffused[i].t_blended), static_cast<float>(diffused[i].t_flat));
        of_the_disc += std::abs(dot(diffused[i].normal, splats[diffused[i].splat].normal)) > 1 - 1e-6;
        apart += std::abs(dot(direct[i].normal, splats[direct[i].splat].normal)) < 1 - 1e-6;
    }
    EXPECT_GT(hits, 900u);
    EXPECT_GT(of_the_disc, hits * 9 / 10); // the others are backs covered by fronts, which take the side of the fronts
    EXPECT_GT(apart, hits / 2);            // the blended normals of visible hits differ
}

} // namespace

} // namespace pointrt::test

// SPDX-License-Identifier: Apache-2.0
// The rays that tracers are timed with, and the comparison of both tracers.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdio>

#include "tests/bench/speed/speed.h"
#include "tests/support/first_hit_check.h"
#include "tests/support/splat_scenes.h"

/// Drivers and layers leak memory.
extern "C" const char* __asan_default_options() { return "detect_leaks=0"; }

namespace pointrt::test {

namespace {

/// A scene in a temporary file.
struct SceneFile {
    std::string path = temporaryPath("speed.pro");
    std::vector<CubeSplat> splats;
    explicit SceneFile(const Splats& scene) {
        writeScene(path, scene, {});
        splats = loadCubeSplats(path);
    }
    ~SceneFile() { std::remove(path.c_str()); }
    SceneFile(const SceneFile&) = delete;
    SceneFile& operator=(const SceneFile&) = delete;
};

/// A floor that rises away from the eye and a sphere above it: some rays of every kind hit.
Splats floorAndSphere() {
    return joinSplats(sphereSplats(4000, Vec3f(0, 0.8f, 0), 0.5f),
                      squareSplats(60, Vec3f(0, 0, 0), Vec3f(2, 0, 0), Vec3f(0, 0.6f, -1.8f)));
}

/// A ray down on z = 0 at (1, 2), from the x side at 45 degrees, and where it hits.
const Vec3 kDown = normalize({1, 0, -1});
const std::vector<Ray> kPrimary{{{0, 2, 1}, kDown, {}, 0}, {{0, 5, 1}, kDown, {}, 0}};
const CastHit kHit{std::sqrt(2.0), 3, std::sqrt(2.0), {0, 0, 1}, 0.1f};
const std::vector<CastHit> kHits{kHit, {}};
const Vec3 kStart{1, 2, kLiftRadii * 0.1}; // above the hit

void expectNear(Vec3 a, Vec3 b) { EXPECT_LT(length(a - b), 1e-6) << a.x << ' ' << a.y << ' ' << a.z; }

TEST(RayKinds, MirrorRaysAreReflectedAboveTheSurface) {
    const std::vector<Ray> rays = raysOf(RayKind::kMirror, kPrimary, kHits, {});
    ASSERT_EQ(rays.size(), 1u); // the other one hits nothing
    expectNear(rays[0].origin, kStart);
    expectNear(rays[0].direction, normalize({1, 0, 1}));
    EXPECT_EQ(rays[0].self_t, 0);
}

TEST(RayKinds, ShadowRaysAimAtALightThatTheSurfaceFaces) {
    const std::vector<Ray> rays = raysOf(RayKind::kShadow, kPrimary, kHits, {1, 2, 5});
    ASSERT_EQ(rays.size(), 1u);
    expectNear(rays[0].origin, kStart);
    expectNear(rays[0].direction, {0, 0, 1});
    EXPECT_TRUE(raysOf(RayKind::kShadow, kPrimary, kHits, {1, 2, -5}).empty());
}

TEST(RayKinds, DiffuseRaysFollowTheCosine) {
    const std::vector<Ray> primary(20'000, kPrimary[0]);
    const std::vector<CastHit> hits(primary.size(), kHit);
    const std::vector<Ray> rays = raysOf(RayKind::kDiffuse, primary, hits, {}, 4);
    ASSERT_EQ(rays.size(), primary.size());
    Vec3 mean;
    for (const Ray& ray : rays) {
        ASSERT_GE(ray.direction.z, 0);
        mean = mean + (1.0 / 20'000) * ray.direction;
    }
    EXPECT_NEAR(mean.z, 2.0 / 3, 0.01); // 0.0017 is the standard error
    EXPECT_NEAR(std::hypot(mean.x, mean.y), 0, 0.02);
    expectNear(raysOf(RayKind::kDiffuse, primary, hits, {}, 4)[99].direction, rays[99].direction);
}

TEST(EmbreeBatch, EveryWayGivesTheSameHits) {
    const SceneFile scene(randomSplats(3000, 5, 0.005f, 0.05f));
    const EmbreeDiscs discs(scene.splats, EmbreeFlag::kFast);
    const std::vector<Ray> rays = randomRays(boundingSphere(scene.splats), 5003, 1); // not a multiple of 8
    const std::vector<EmbreeHit> expected = discs.cast(rays);
    EXPECT_GT(discs.bytes(), 28 * 3000); // a disc's own floats
    for (const EmbreeMode mode : {EmbreeMode::kSingle, EmbreeMode::kPackets})
        for (const bool any_hit : {false, true}) {
            const EmbreeRun run = runEmbree(discs, rays, mode, any_hit, mode == EmbreeMode::kPackets);
            ASSERT_EQ(run.hits.size(), rays.size());
            EXPECT_GT(run.seconds, 0);
            std::size_t hits = 0, other = 0;
            for (std::size_t i = 0; i < rays.size(); ++i) {
                const bool hit = run.hits[i].splat != kNoSplat, expected_hit = expected[i].splat != kNoSplat;
                hits += hit;
                other += any_hit ? hit != expected_hit : run.hits[i].splat != expected[i].splat;
            }
            EXPECT_GT(hits, rays.size() / 3);
            EXPECT_LE(other, 2u); // rims: packets use fused multiply-add differently
        }
}

TEST(RayCaster, CameraRaysComeInTilesThatCoverTheView) {
    const SceneFile scene(floorAndSphere());
    RayCaster caster(scene.path);
    const Sphere bounds = boundingSphere(scene.splats);
    EXPECT_GT(length(caster.lightPosition() - bounds.center), bounds.radius);
    const std::vector<Ray> rays = caster.cameraRays(64);
    ASSERT_EQ(rays.size(), 64u * 64);
    const double pixel = 2 * std::tan(0.349066) / 64; // half of 40 degrees
    double lowest = 0, highest = 0;
    for (std::size_t i = 0; i < rays.size(); ++i) {
        const Vec3 at = rays[i].direction * (-1 / rays[i].direction.z), first = rays[i & ~7u].direction;
        lowest = std::min(lowest, at.x);
        highest = std::max(highest, at.y);
        EXPECT_LT(length(at - first * (-1 / first.z)), 3.5 * pixel) << i; // a tile of 4x2 from its first pixel
    }
    EXPECT_NEAR(lowest, -31.5 * pixel, 1e-5);
    EXPECT_NEAR(highest, 31.5 * pixel, 1e-5);
}

TEST(RayCaster, AnyHitsMatchFirstHits) {
    const SceneFile scene(floorAndSphere());
    RayCaster caster(scene.path);
    const std::vector<Ray> rays = randomRays(boundingSphere(scene.splats), 4000, 2);
    const std::vector<CastHit> expected = caster.cast(rays);
    caster.load(rays);
    caster.traceLoaded(true);
    const std::vector<CastHit> any = caster.loadedHits();
    caster.traceLoaded(false);
    const std::vector<CastHit> first = caster.loadedHits();
    std::size_t hits = 0;
    for (std::size_t i = 0; i < rays.size(); ++i) {
        hits += any[i].hit();
        ASSERT_EQ(any[i].hit(), expected[i].hit()) << i;
        ASSERT_EQ(first[i].splat, expected[i].splat) << i;
    }
    EXPECT_GT(hits, 400u);
}

TEST(Speed, HitsAreEqualIfTheSplatOrTheDistanceIs) {
    const std::vector<CubeSplat> splats{{{}, {0, 0, 1}, 0.1}, {{}, {0, 0, 1}, 0.1}};
    const CastHit first{2, 0, 2, {}, 0}, none;
    EXPECT_TRUE(sameFirstHit(splats, none, {}));
    EXPECT_TRUE(sameFirstHit(splats, first, {2.1, 0}));
    EXPECT_TRUE(sameFirstHit(splats, first, {2 + 0.5 * kSameHitRadii * 0.1, 1}));
    EXPECT_FALSE(sameFirstHit(splats, first, {2 + 2 * kSameHitRadii * 0.1, 1}));
    EXPECT_FALSE(sameFirstHit(splats, first, {}));
    EXPECT_FALSE(sameFirstHit(splats, none, {2, 0}));
}

TEST(Speed, TracersAgreeAndLostDiscsAreNoticed) {
    const SceneFile scene(floorAndSphere());
    const EmbreeDiscs discs(scene.splats, EmbreeFlag::kFast);
    std::vector<CubeSplat> thinned = scene.splats;
    for (std::size_t s = 0; s < thinned.size(); ++s)
        if (s % 8 != 0) thinned[s].radius = 1e-6;
    const EmbreeDiscs without(thinned, EmbreeFlag::kFast);
    RayCaster caster(scene.path);
    const std::vector<Ray> primary = caster.cameraRays(128);
    const std::vector<CastHit> hits = caster.cast(primary);
    for (const RayKind kind : kRayKinds) {
        const std::vector<Ray> rays = raysOf(kind, primary, hits, caster.lightPosition());
        const Speed speed = measureSpeed(caster, discs, scene.splats, rays, kind, 3);
        EXPECT_EQ(speed.rays, rays.size());
        EXPECT_GT(speed.hit_share, 0.005) << nameOf(kind);
        EXPECT_LT(speed.hit_share, 0.95) << nameOf(kind);
        EXPECT_GT(speed.agreement, 0.997) << nameOf(kind); // rims, and the order of two discs at grazing angles
        EXPECT_GT(speed.ours, 0);
        EXPECT_GT(speed.ratio_min, 0);
        EXPECT_LE(speed.ratio_min, speed.ratio);
        EXPECT_LE(speed.ratio, speed.ratio_max);
        EXPECT_GT(speed.ratio_blended, 0);
        EXPECT_EQ(speed.ratio_blended < speed.ratio, kind != RayKind::kShadow) << nameOf(kind);
        const double lost = 1 - measureSpeed(caster, without, scene.splats, rays, kind, 1).agreement;
        EXPECT_GT(lost, 0.1 * speed.hit_share) << nameOf(kind);
    }
}

} // namespace

} // namespace pointrt::test

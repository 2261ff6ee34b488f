// SPDX-License-Identifier: Apache-2.0
// Rays and balls: first hits and normals are those of exact spheres, and rays that leave a ball see what is around it.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>
#include <optional>
#include <random>
#include <vector>

#include "tests/support/cube_splats.h"
#include "tests/support/embree_discs.h"
#include "tests/support/ray_caster.h"
#include "tests/support/splat_scenes.h"

namespace pointrt::test {
namespace {

constexpr std::size_t kBallRays = 20'000;
/// Bound of the rounding of near splats (pointrt/pro_index_layout.h), in radii: half a step of the radius, 2^-7, and
/// half a position code per axis, of which there are at least 20 to the radius of the smallest ball of a row
/// (format/index/cell_runs.cpp).
const double kBallRounding = 1.0 / 128 + std::sqrt(3.0) / 2 / 20;
/// Bound of the error of a ray's distance from a centre, in cube units: a few roundings of numbers below 4.
constexpr double kExactDistance = 2e-6;
constexpr double kNoDistance = std::numeric_limits<double>::infinity();

/// A scene in a temporary file.
struct BallScene {
    std::string path = temporaryPath("balls.pro");
    std::vector<CubeSplat> splats;
    explicit BallScene(const Splats& scene, const BuildOptions& options = {}) {
        writeScene(path, scene, options);
        splats = loadCubeSplats(path);
    }
    ~BallScene() { std::remove(path.c_str()); }
    BallScene(const BallScene&) = delete;
    BallScene& operator=(const BallScene&) = delete;
};

Splats randomBalls(std::size_t count, unsigned seed, float radius_min, float radius_max) {
    Splats splats = randomSplats(count, seed, radius_min, radius_max);
    makeBalls(splats);
    return splats;
}

/// Every second splat is a ball.
Splats ballsAmongDiscs(std::size_t count, unsigned seed) {
    Splats splats = randomSplats(count, seed, 0.01f, 0.04f);
    for (std::size_t i = 0; i < count; i += 2) splats.normals[i].setZero();
    return splats;
}

/// Distance to a splat: for a ball, to the point where the ray enters it, or leaves it if its origin is inside.
/// @param scale multiplies the radius
double distanceAlong(const CubeSplat& splat, const Ray& ray, double scale) {
    const double radius = scale * splat.radius;
    const Vec3 to_center = splat.center - ray.origin;
    if (splat.normal != Vec3{}) {
        const DiscHit plane = meetPlane(splat, ray.origin, ray.direction);
        return plane.t > 0 && plane.share < scale ? plane.t : kNoDistance;
    }
    const double middle = dot(to_center, ray.direction);
    const double half_squared = radius * radius - dot(to_center, to_center) + middle * middle;
    if (half_squared <= 0) return kNoDistance;
    const double half = std::sqrt(half_squared), t = middle - half > 0 ? middle - half : middle + half;
    return t > 0 ? t : kNoDistance;
}

/// Bound of the error of an exact distance: the derivative of half the chord by the distance from the centre is the
/// inverse slope.
double distanceError(const CubeSplat& splat, const Ray& ray) {
    const Vec3 hit = ray.origin + distanceAlong(splat, ray, 1) * ray.direction - splat.center;
    const double slope = splat.normal == Vec3{} ? std::abs(dot(hit, ray.direction)) / splat.radius
                                                : std::abs(dot(splat.normal, ray.direction));
    return kExactDistance + kExactDistance / std::max(slope, std::sqrt(kExactDistance / splat.radius));
}

struct NearestSplat {
    double t = kNoDistance;
    std::uint32_t splat = kNoSplat;
};

NearestSplat nearestSplat(std::span<const CubeSplat> splats, const Ray& ray, double scale = 1) {
    NearestSplat best;
    for (std::uint32_t i = 0; i < splats.size(); ++i) {
        const double t = distanceAlong(splats[i], ray, scale);
        if (t < best.t) best = {t, i};
    }
    return best;
}

struct HitComparison {
    std::size_t hits = 0, same = 0, inexact = 0, unexplained = 0;
};

/// Compares first hits with those of exact spheres. From outside, a rounded ball is hit between where balls larger by
/// the rounding are, and smaller ones.
HitComparison compareHits(const BallScene& scene, std::span<const Ray> rays, std::span<const CastHit> ours) {
    HitComparison result;
    for (std::size_t i = 0; i < rays.size(); ++i) {
        const NearestSplat exact = nearestSplat(scene.splats, rays[i]);
        const CastHit& hit = ours[i];
        result.hits += hit.hit();
        if (hit.splat == exact.splat) {
            ++result.same;
            result.inexact +=
                hit.hit() && std::abs(hit.t_flat - exact.t) > distanceError(scene.splats[hit.splat], rays[i]);
            continue;
        }
        const NearestSplat grown = nearestSplat(scene.splats, rays[i], 1 + kBallRounding),
                           shrunk = nearestSplat(scene.splats, rays[i], 1 - kBallRounding);
        const double radius = hit.hit() ? scene.splats[hit.splat].radius : 0, t = hit.hit() ? hit.t_flat : kNoDistance;
        // the exact distance of a grazing ray is off by half the chord at the rounding's depth
        result.unexplained +=
            t < grown.t - kExactDistance || t > shrunk.t + std::sqrt(4 * kBallRounding) * radius + kExactDistance;
    }
    std::printf("%zu rays, %zu hits, %zu same, %zu inexact, %zu unexplained\n", rays.size(), result.hits, result.same,
                result.inexact, result.unexplained);
    return result;
}

void expectExactSpheres(const Splats& splats, double same, const BuildOptions& options = {}) {
    const BallScene scene(splats, options);
    const std::vector<Ray> rays = randomRays(boundingSphere(scene.splats), kBallRays, 3);
    const HitComparison result = compareHits(scene, rays, RayCaster(scene.path).cast(rays));
    EXPECT_GT(result.hits, kBallRays / 4);
    EXPECT_GT(result.same, static_cast<std::size_t>(same * kBallRays));
    EXPECT_EQ(result.inexact, 0u);
    EXPECT_EQ(result.unexplained, 0u);
}

TEST(Balls, FirstHitsAreThoseOfExactSpheres) { expectExactSpheres(randomBalls(2000, 1, 0.01f, 0.04f), 0.99); }

/// Embree's spheres, with a hierarchy of its own. Where the first ball differs, rounding explains it.
TEST(Balls, FirstHitsAreThoseOfEmbreesSpheres) {
    const BallScene scene(ballsAmongDiscs(3000, 13));
    const std::vector<Ray> rays = randomRays(boundingSphere(scene.splats), 5 * kBallRays, 14);
    const std::vector<CastHit> ours = RayCaster(scene.path).cast(rays);
    const std::vector<EmbreeHit> embrees = EmbreeDiscs(scene.splats).cast(rays);
    std::size_t hits = 0, near = 0;
    for (std::size_t i = 0; i < rays.size(); ++i) {
        if (ours[i].splat == kNoSplat && embrees[i].splat == kNoSplat) continue;
        ++hits;
        if (ours[i].splat != embrees[i].splat) continue;
        near += std::abs(ours[i].t_flat - embrees[i].t) <= 2 * distanceError(scene.splats[ours[i].splat], rays[i]);
    }
    std::vector<Ray> different;
    std::vector<CastHit> of_different;
    for (std::size_t i = 0; i < rays.size(); ++i)
        if (ours[i].splat != embrees[i].splat) different.push_back(rays[i]), of_different.push_back(ours[i]);
    const HitComparison rest = compareHits(scene, different, of_different);
    std::printf("%zu rays, %zu hits, %zu the same within float\n", rays.size(), hits, near);
    EXPECT_GT(hits, rays.size() / 4);
    EXPECT_GT(near, hits * 98 / 100); // stored lists round balls to kBallRounding
    EXPECT_GE(near + different.size() - rest.unexplained - rest.inexact, hits * 9999 / 10000);
}

TEST(Balls, OfManySizesAreHit) { expectExactSpheres(randomBalls(1000, 2, 0.002f, 0.2f), 0.99); }

TEST(Balls, InASingleLeafAreHit) {
    BuildOptions options;
    options.octree.max_depth = 0;
    expectExactSpheres(randomBalls(300, 4, 0.01f, 0.1f), 0.99, options);
}

TEST(Balls, AmongDiscsAreHit) { expectExactSpheres(ballsAmongDiscs(3000, 5), 0.99); }

TEST(Balls, OfPrunedFilesAreHit) {
    BuildOptions options;
    options.prune = true;
    const BallScene scene(ballsAmongDiscs(3000, 6), options);
    const std::vector<Ray> rays = randomRays(boundingSphere(scene.splats), kBallRays, 7);
    const HitComparison result = compareHits(scene, rays, RayCaster(scene.path).cast(rays));
    EXPECT_LE(result.inexact + result.unexplained, kBallRays / 5000); // PruneOptions::harm is half of that
}

/// Rays from random points, some of which are inside balls.
TEST(Balls, AreHitFromInside) {
    const BallScene scene(randomBalls(60, 8, 0.1f, 0.25f));
    std::mt19937 random(9);
    std::uniform_real_distribution<float> unit(0.3f, 0.7f);
    std::vector<Ray> rays = randomRays(boundingSphere(scene.splats), 4000, 10);
    for (Ray& ray : rays) ray.origin = {unit(random), unit(random), unit(random)};
    const std::vector<CastHit> hits = RayCaster(scene.path).cast(rays);
    std::size_t all = 0, inside = 0, same = 0, far_off = 0;
    for (std::size_t i = 0; i < rays.size(); ++i) {
        const NearestSplat exact = nearestSplat(scene.splats, rays[i]);
        if (exact.splat == kNoSplat) continue;
        const CubeSplat& ball = scene.splats[exact.splat];
        const bool from_inside = length(rays[i].origin - ball.center) < ball.radius;
        ++all;
        inside += from_inside;
        if (hits[i].splat != exact.splat) continue;
        ++same;
        far_off += std::abs(hits[i].t_flat - exact.t) > distanceError(ball, rays[i]) || hits[i].back != from_inside;
    }
    std::printf("%zu of %zu inside, %zu same, %zu far off\n", inside, all, same, far_off);
    EXPECT_GT(inside, 1000u);
    EXPECT_GT(same, all * 97 / 100);
    EXPECT_EQ(far_off, 0u);
}

TEST(Balls, HaveTheNormalsOfSpheres) {
    const BallScene scene(randomBalls(2000, 11, 0.01f, 0.04f));
    const std::vector<Ray> rays = randomRays(boundingSphere(scene.splats), kBallRays, 12);
    const std::vector<CastHit> hits = RayCaster(scene.path).cast(rays);
    std::size_t hit = 0;
    for (std::size_t i = 0; i < rays.size(); ++i) {
        if (!hits[i].hit()) continue;
        const CubeSplat& ball = scene.splats[hits[i].splat];
        const Vec3 out = rays[i].origin + hits[i].t_flat * rays[i].direction - ball.center;
        EXPECT_EQ(hits[i].t_blended, hits[i].t_flat);             // they do not blend
        EXPECT_LT(length(hits[i].normal - normalize(out)), 0.02); // bent to the viewer by 0.01
        EXPECT_FALSE(hits[i].back);
        hit += std::abs(length(out) / ball.radius - 1) < 1e-3;
    }
    EXPECT_GT(hit, kBallRays / 4);
}

/// Discs blend with each other as if there were no balls among them.
TEST(Balls, DoNotBlend) {
    const Splats sphere = sphereSplats(5000, Vec3f(0, 0, 0), 1);
    Splats balls = sphereSplats(500, Vec3f(0, 0, 0), 0.9f, 0.2f); // hidden by the discs
    makeBalls(balls);
    const BallScene alone(sphere), both(joinSplats(sphere, balls));
    ASSERT_NEAR(alone.splats[0].radius / both.splats[0].radius, 1, 1e-3); // of the same cube
    const std::vector<Ray> rays = randomRays(boundingSphere(alone.splats), kBallRays, 13);
    const std::vector<CastHit> expected = RayCaster(alone.path).cast(rays), hits = RayCaster(both.path).cast(rays);
    std::size_t different = 0;
    for (std::size_t i = 0; i < rays.size(); ++i)
        different +=
            expected[i].hit() != hits[i].hit() || (hits[i].hit() && length(expected[i].normal - hits[i].normal) > 0.02);
    EXPECT_LT(different, kBallRays / 500); // where rounding decides which disc is first
}

/// A ray that leaves a surface as shaders/trace/offset.glsl computes it.
Ray leaveBall(const Ray& ray, const CastHit& hit, const Vec3& direction) {
    Ray left;
    left.direction = direction;
    left.self_normal = hit.normal;
    left.origin = ray.origin + hit.t_blended * ray.direction + 0.25 * double{hit.radius} * hit.normal;
    left.self_t = double{hit.radius} * std::min(3 / std::max(dot(hit.normal, direction), 1e-6), 8.0);
    return left;
}

Vec3 diffuseAround(const Vec3& normal, std::mt19937& random) {
    std::normal_distribution<double> gauss;
    const Vec3 any{gauss(random), gauss(random), gauss(random)};
    return normalize(normal + 0.9999 * normalize(any));
}

/// Rays that leave hits on balls diffusely, and the balls.
struct LeftBalls {
    std::vector<Ray> rays;
    std::vector<std::uint32_t> from;
};

LeftBalls leaveBalls(RayCaster& caster, std::span<const Ray> rays) {
    const std::vector<CastHit> hits = caster.cast(rays);
    std::mt19937 random(14);
    LeftBalls left;
    for (std::size_t i = 0; i < rays.size(); ++i) {
        if (!hits[i].hit()) continue;
        left.rays.push_back(leaveBall(rays[i], hits[i], diffuseAround(hits[i].normal, random)));
        left.from.push_back(hits[i].splat);
    }
    return left;
}

TEST(Balls, AreNotHitByRaysThatLeaveThem) {
    Splats apart;
    apart.oriented = true;
    for (int x = 0; x < 5; ++x)
        for (int y = 0; y < 5; ++y) {
            Splats ball = sphereSplats(1, Vec3f(float(x), float(y), 0), 0.001f);
            ball.radii[0] = 0.1f + 0.02f * float(y);
            apart = joinSplats(apart, ball);
        }
    makeBalls(apart);
    const BallScene scene(apart);
    RayCaster caster(scene.path);
    const std::vector<Ray> rays = randomRays(boundingSphere(scene.splats), 20 * kBallRays, 15);
    const LeftBalls left = leaveBalls(caster, rays);
    ASSERT_GT(left.rays.size(), 5000u);
    const std::vector<CastHit> hits = caster.cast(left.rays);
    std::size_t own = 0;
    for (std::size_t i = 0; i < hits.size(); ++i) own += hits[i].splat == left.from[i];
    EXPECT_EQ(own, 0u);
}

/// Rays that leave balls of a heap hit what they would hit from the exact surface, without the lift and without the
/// ball that they leave.
TEST(Balls, OfAHeapShadeEachOther) {
    const BallScene scene(randomBalls(3000, 16, 0.02f, 0.04f));
    RayCaster caster(scene.path);
    const LeftBalls left = leaveBalls(caster, randomRays(boundingSphere(scene.splats), kBallRays, 17));
    const std::vector<CastHit> hits = caster.cast(left.rays);
    std::size_t occluded = 0, false_light = 0, false_shadow = 0;
    for (std::size_t i = 0; i < left.rays.size(); ++i) {
        Ray exact = left.rays[i];
        const CubeSplat& ball = scene.splats[left.from[i]];
        exact.origin = ball.center + ball.radius * normalize(left.rays[i].origin - ball.center);
        std::vector<CubeSplat> others = scene.splats;
        others[left.from[i]].radius = 0;
        const bool hit = nearestSplat(others, exact).splat != kNoSplat;
        occluded += hit;
        false_light += hit && !hits[i].hit();
        false_shadow += !hit && hits[i].hit();
    }
    std::printf("%zu rays, %zu occluded, %zu false light, %zu false shadow\n", hits.size(), occluded, false_light,
                false_shadow);
    EXPECT_GT(occluded, hits.size() / 10);
    EXPECT_LT(false_light, hits.size() / 100);
    EXPECT_LT(false_shadow, hits.size() / 100);
}

/// Shadow rays agree with closest hits on what is occluded.
TEST(Balls, OccludeAsTheyAreHit) {
    const BallScene scene(ballsAmongDiscs(2000, 18));
    const std::vector<Ray> rays = randomRays(boundingSphere(scene.splats), kBallRays, 19);
    RayCaster caster(scene.path);
    caster.load(rays);
    caster.traceLoaded();
    const std::vector<CastHit> closest = caster.loadedHits();
    caster.traceLoaded(true);
    const std::vector<CastHit> any = caster.loadedHits();
    for (std::size_t i = 0; i < rays.size(); ++i) ASSERT_EQ(any[i].hit(), closest[i].hit()) << i;
}

} // namespace
} // namespace pointrt::test

// SPDX-License-Identifier: Apache-2.0
// First hits of arbitrary rays, compared with Embree's oriented discs, and the rays themselves.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "pointrt/pro.hpp"
#include "tests/support/first_hit_check.h"
#include "tests/support/pruning_change.h"
#include "tests/support/splat_scenes.h"
#include "tests/trace/reference.h"

/// As in render_helper.cpp: drivers and layers leak memory.
extern "C" const char* __asan_default_options() { return "detect_leaks=0"; }

namespace pointrt::test {

namespace {

constexpr std::size_t kRays = 20'000;

/// A scene in a temporary file.
struct EmbreeSceneFile {
    std::string path = temporaryPath("embree.pro");
    std::vector<CubeSplat> splats;
    explicit EmbreeSceneFile(const Splats& scene, const BuildOptions& options = {}) {
        writeScene(path, scene, options);
        splats = loadCubeSplats(path);
    }
    ~EmbreeSceneFile() { std::remove(path.c_str()); }
    EmbreeSceneFile(const EmbreeSceneFile&) = delete;
    EmbreeSceneFile& operator=(const EmbreeSceneFile&) = delete;
};

std::vector<Ray> bothKinds(std::span<const CubeSplat> splats, std::size_t count, std::uint64_t seed) {
    std::vector<Ray> rays = randomRays(boundingSphere(splats), count, seed);
    const std::vector<Ray> grazing = grazingRays(splats, count, seed);
    rays.insert(rays.end(), grazing.begin(), grazing.end());
    return rays;
}

/// Compares our hits with Embree's on embree_splats.
FirstHitCheck check(const EmbreeSceneFile& scene, std::span<const CubeSplat> embree_splats, std::uint64_t seed) {
    const std::vector<Ray> rays = bothKinds(scene.splats, kRays, seed);
    const std::uint64_t messages = validationMessages();
    RayCaster caster(scene.path);
    const std::vector<CastHit> ours = caster.cast(rays);
    EXPECT_EQ(validationMessages(), messages);
    const FirstHitCheck result = checkFirstHits(scene.splats, nearRounding(scene.splats, caster.cellEdge()), rays, ours,
                                                EmbreeDiscs(embree_splats).cast(rays));
    std::printf("%zu rays, %zu hits, %zu agree, rim %zu, tie %zu, rounding %zu, unexplained %zu\n", result.rays,
                result.hits, result.count(Verdict::kAgree), result.count(Verdict::kRim), result.count(Verdict::kTie),
                result.count(Verdict::kRounding), result.unexplained.size());
    return result;
}

/// agreement: the smallest share of rays, half of them grazing, that must have the same hit.
void expectEmbreesHits(double agreement, const Splats& splats, const BuildOptions& options = {}) {
    const EmbreeSceneFile scene(splats, options);
    const FirstHitCheck result = check(scene, scene.splats, 1);
    EXPECT_GT(result.hits, kRays); // grazing rays hit the disc they are aimed at, or one before it
    EXPECT_EQ(result.unexplained.size(), 0u);
    EXPECT_GT(result.agreement(), agreement);
}

// Where discs overlap nearly in one plane, a grazing ray of slope 0.1 meets the next one 0.1 radii further away for
// each hundredth that rounding moves it: a fifth of those rays hits another disc first.
TEST(Embree, AgreesOnASphere) { expectEmbreesHits(0.87, sphereSplats(20000, Vec3f(10, -20, 5), 2.0f)); }

TEST(Embree, AgreesOnSheetsALeafApart) {
    const auto sheet = [](float z) {
        return squareSplats(80, Vec3f(0, 0, z), Vec3f(1, 0, 0), Vec3f(0, 0.8f, 0.6f), 1.3f);
    };
    expectEmbreesHits(0.89, joinSplats(sheet(0), sheet(0.02f)));
}

TEST(Embree, AgreesOnRandomDiscsOfManySizes) {
    for (const unsigned seed : {1u, 2u, 3u}) {
        BuildOptions options;
        options.octree.max_leaf_splats = seed * seed * 4;
        expectEmbreesHits(0.985, randomSplats(1000u << (2 * seed), seed, 0.003f, 0.05f), options);
    }
}

TEST(Embree, AgreesInASingleLeaf) {
    BuildOptions options;
    options.octree.max_depth = 0;
    expectEmbreesHits(0.968, randomSplats(500, 7, 0.01f, 0.1f), options);
}

/// A stray far away makes the sphere's leaves so small that one position step, which rays look ahead, is a large part
/// of a leaf.
TEST(Embree, TinyLeavesLoseNoHits) {
    constexpr float kFar = 40000; // radii: discs of about one position step, leaves at depth 18
    const EmbreeSceneFile scene(
        joinSplats(sphereSplats(20000, Vec3f(0, 0, 0), 1.0f), sphereSplats(1, Vec3f(kFar, 0, 0), 0.01f)));
    const std::vector<Ray> rays = grazingRays(scene.splats, kRays, 5);
    const std::vector<CastHit> ours = RayCaster(scene.path).cast(rays);
    const std::vector<EmbreeHit> embrees = EmbreeDiscs(scene.splats).cast(rays);
    std::size_t later = 0, sooner = 0;
    for (std::size_t i = 0; i < rays.size(); ++i) {
        const double mine = ours[i].hit() ? ours[i].t_flat : 10,
                     other = embrees[i].splat == kNoSplat ? 10 : embrees[i].t;
        const double apart = mine - other, clearly = 0.1 * scene.splats.front().radius;
        later += apart > clearly;
        sooner += apart < -clearly;
    }
    std::printf("%zu later than Embree, %zu sooner\n", later, sooner);
    EXPECT_LE(later, sooner + sooner / 3 + 10); // rounding moves hits either way; missing references only lose hits
}

TEST(Embree, LostDiscsAreUnexplained) {
    const EmbreeSceneFile scene(
        sphereSplats(500, Vec3f(0, 0, 0), 1.0f, 0.7f)); // discs hardly overlap, so that it leaves a hole
    std::vector<CubeSplat> without = scene.splats;
    without[123].radius = 1e-6;
    const FirstHitCheck result = check(scene, without, 2);
    EXPECT_GT(result.count(Verdict::kEmbreeMisses),
              10u); // about 40000 / 500 rays, fewer near its rim
    EXPECT_EQ(result.count(Verdict::kWeMiss), 0u);
}

TEST(Embree, PacketsHitWhatSingleRaysHit) {
    const EmbreeSceneFile scene(randomSplats(5000, 5, 0.005f, 0.05f));
    const EmbreeDiscs embree(scene.splats);
    const std::vector<Ray> rays = bothKinds(scene.splats, 3003, 3); // not a multiple of 8
    const std::vector<EmbreeHit> single = embree.cast(rays), packets = embree.castPackets(rays);
    std::size_t hits = 0, other = 0;
    for (std::size_t i = 0; i < rays.size(); ++i) {
        hits += single[i].splat != kNoSplat;
        other += single[i].splat != packets[i].splat;
    }
    EXPECT_GT(hits, rays.size() / 2);
    EXPECT_LE(other, 2u); // rims: packets use fused multiply-add differently
}

/// A unit disc at the origin facing +z, and one below it.
const std::vector<CubeSplat> kDiscs{{{0, 0, 0}, {0, 0, 1}, 1}, {{0, 0, -0.1}, {0, 0, 1}, 1}};
/// Centres may be off by a hundredth of a radius.
constexpr NearRounding kRounded{0.01, 0.01, 1};

/// The verdict on a difference at the first disc, which a ray from above with this slope crosses at x.
Verdict verdictAt(double x, bool we_hit, bool embree_hits, double slope = 1) {
    const Vec3 direction{std::sqrt(1 - slope * slope), 0, -slope};
    const Ray ray{Vec3{x, 0, 0} - direction, direction, {}, 0};
    CastHit ours;
    EmbreeHit embrees;
    if (we_hit) ours.splat = 0, ours.t_flat = 1;
    if (embree_hits) embrees = {1, 0};
    return judge(kDiscs, kRounded, ray, ours, embrees);
}

TEST(Embree, DisputesAreExplainedByRounding) {
    EXPECT_EQ(verdictAt(0.5, true, true), Verdict::kAgree);
    EXPECT_EQ(verdictAt(1.5, false, false), Verdict::kAgree);
    EXPECT_EQ(verdictAt(0.5, false, true), Verdict::kWeMiss);
    EXPECT_EQ(verdictAt(0.5, true, false), Verdict::kEmbreeMisses);
    EXPECT_EQ(verdictAt(1.5, true, false), Verdict::kWeMiss);
    EXPECT_EQ(verdictAt(1.5, false, true), Verdict::kEmbreeMisses);
    EXPECT_EQ(verdictAt(0.983, false, true), Verdict::kRim); // 0.01 of the centre and 0.0078 of the radius
    EXPECT_EQ(verdictAt(1.017, true, false), Verdict::kRim);
    EXPECT_EQ(verdictAt(0.98, false, true), Verdict::kWeMiss);
    EXPECT_EQ(verdictAt(1.02, true, false), Verdict::kWeMiss);
    // the plane is 0.0156 higher or lower at the rim: along a ray of slope 0.1 that is 0.165
    EXPECT_EQ(verdictAt(0.82, false, true, 0.1), Verdict::kRounding);
    EXPECT_EQ(verdictAt(0.8, false, true, 0.1), Verdict::kWeMiss);
    EXPECT_EQ(verdictAt(0.2, false, true, 0.005), Verdict::kRounding); // the ray may be parallel to the plane
}

/// Both hit at x = 0: we the lower disc, Embree the upper one. gap: their distance.
Verdict orderAt(double gap, double slope) {
    std::vector<CubeSplat> discs = kDiscs;
    discs[1].center.z = -gap;
    const Vec3 direction{std::sqrt(1 - slope * slope), 0, -slope};
    const Ray ray{-1.0 * direction, direction, {}, 0};
    return judge(discs, kRounded, ray, {1 + gap / slope, 1, 0, {}, 0}, {1, 0});
}

TEST(Embree, OrderMayChangeWithinRounding) {
    EXPECT_EQ(orderAt(0.014, 1), Verdict::kAgree); // counts as the same hit
    EXPECT_EQ(orderAt(0.03, 1), Verdict::kTie);    // twice 0.0156
    EXPECT_EQ(orderAt(0.035, 1), Verdict::kWeMiss);
    EXPECT_EQ(orderAt(0.03, 0.2), Verdict::kRounding);
    EXPECT_EQ(orderAt(0.035, 0.2), Verdict::kWeMiss);
}

TEST(Embree, FirstHitsAreLimitedByRounding) {
    const Ray middle{{0, 0, 1}, {0, 0, -1}, {}, 0}, rim{{0.99, 0, 1}, {0, 0, -1}, {}, 0},
        past{{2, 0, 1}, {0, 0, -1}, {}, 0};
    const auto may = [](const Ray& ray, std::optional<double> t) { return mayBeFirst(kDiscs, kRounded, ray, t); };
    EXPECT_TRUE(may(middle, 1.0));
    EXPECT_FALSE(may(middle, 1.1));   // behind a sure hit
    EXPECT_FALSE(may(middle, 1.001)); // the distance of no disc
    EXPECT_FALSE(may(middle, std::nullopt));
    EXPECT_TRUE(may(rim, 1.0));
    EXPECT_TRUE(may(rim, 1.1));
    EXPECT_TRUE(may(rim, std::nullopt));
    EXPECT_FALSE(may(past, 1.0));
    EXPECT_TRUE(may(past, std::nullopt));
}

TEST(Rays, StartOutsideTheScene) {
    const EmbreeSceneFile scene(randomSplats(300, 11, 0.01f, 0.1f));
    const Sphere bounds = boundingSphere(scene.splats);
    const std::vector<Ray> rays = bothKinds(scene.splats, 5000, 4), again = bothKinds(scene.splats, 5000, 4);
    Vec3 mean;
    for (std::size_t i = 0; i < rays.size(); ++i) {
        const Ray& ray = rays[i];
        ASSERT_GT(length(ray.origin - bounds.center), bounds.radius) << i;
        ASSERT_NEAR(length(ray.direction), 1, 1e-6) << i;
        ASSERT_EQ(ray.origin.x, static_cast<float>(ray.origin.x)) << i;
        ASSERT_EQ(ray.direction.z, again[i].direction.z) << i;
        const Vec3 to_center = bounds.center - ray.origin;
        ASSERT_LE(length(cross(to_center, ray.direction)), bounds.radius * (1 + 1e-6)) << i;
        if (i < 5000) mean = mean + (1.0 / 5000) * ray.direction;
        if (i < 5000) continue;
        const bool grazes = std::any_of(scene.splats.begin(), scene.splats.end(), [&](const CubeSplat& splat) {
            const DiscHit at = meetPlane(splat, ray.origin, ray.direction);
            return at.share < 1 + 1e-3 && at.slope < std::sin(0.1746); // 10 degrees, with some rounding
        });
        ASSERT_TRUE(grazes) << i;
    }
    EXPECT_LT(length(mean), 0.05); // 5000 unit vectors: 0.014 is expected
}

TEST(Rays, BlendedSurfacesMatchTheReference) {
    const EmbreeSceneFile file(sphereSplats(3000, Vec3f(10, -20, 5), 2.0f));
    const pro_info info = ProFile(file.path).info();
    const Reference reference = loadReference(file.path);
    const Vec3 origin{info.origin[0], info.origin[1], info.origin[2]};
    const std::vector<Ray> rays = randomRays(boundingSphere(file.splats), 2000, 6);
    const std::vector<CastHit> hits = RayCaster(file.path).cast(rays);
    std::size_t both = 0, wrong = 0;
    for (std::size_t i = 0; i < rays.size(); ++i) {
        const auto expected = firstSurface(reference, origin + info.scale * rays[i].origin, rays[i].direction);
        if (!expected || !hits[i].hit()) {
            wrong += expected.has_value() != hits[i].hit();
            continue;
        }
        ++both;
        wrong += std::abs(hits[i].t_blended * info.scale - expected->t) > 2e-4 ||
                 dot(hits[i].normal, expected->normal) < 0.9998;
    }
    EXPECT_GT(both, 700u);
    EXPECT_LE(wrong, both / 100); // leaf lists end where weights have nearly reached zero
}

TEST(Pruning, ChangesAreMeasuredAlongRayAndNormal) {
    const std::vector<CubeSplat> splats{{{0, 0, 0}, {0, 0, 1}, 0.1}};
    const Vec3 slanted = normalize({std::sqrt(3.0), 0, -1}); // 30 degrees over the disc
    const std::vector<Ray> rays(4, Ray{{0, 0, 1}, slanted, {}, 0});
    const CastHit hit{2, 0, 2, {0, 0, 1}, 0.1f};
    CastHit nearer = hit, turned = hit;
    nearer.t_flat = nearer.t_blended = 2 - 0.0015; // 1.5 hundredths of the radius along the ray, half along the normal
    turned.normal = normalize({0, 1, std::sqrt(3.0)});
    const std::vector<CastHit> full{hit, hit, hit, {}}, pruned{nearer, turned, {}, hit};
    const PruningChange change = measurePruning(splats, rays, full, pruned);
    EXPECT_EQ(change.lost, 1u);
    EXPECT_EQ(change.gained, 1u);
    EXPECT_EQ(change.hits_both, 2u);
    EXPECT_EQ(change.flat.moved_along_ray, 1u);
    EXPECT_EQ(change.blended.moved_along_ray, 1u);
    EXPECT_EQ(change.blended.moved_along_normal, 0u);
    EXPECT_NEAR(change.blended.move_max, 0.0075, 1e-6);
    EXPECT_NEAR(change.blended.angle_max, 30, 1e-6);
    EXPECT_NEAR(change.blended.angle_mean, 15, 1e-6);
    EXPECT_NEAR(change.flat.angle_max, 0, 1e-9);
}

} // namespace

} // namespace pointrt::test

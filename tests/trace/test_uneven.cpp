// SPDX-License-Identifier: Apache-2.0
// Scenes whose density varies a thousandfold, where cells of bricks are subdivided: first hits, compared with Embree's
// and with brute force.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdio>
#include <iterator>
#include <optional>

#include "tests/support/first_hit_check.h"
#include "tests/support/splat_scenes.h"

namespace pointrt::test {

namespace {

constexpr std::size_t kUnevenRays = 10'000;

/// A sheet of sparse splats, and on it a body with a thousand times their density.
Splats bodyOnSheet() {
    return joinSplats(squareSplats(30, Vec3f(0, 0, 0), Vec3f(10, 0, 0), Vec3f(0, 10, 1), 1.2f),
                      sphereSplats(12000, Vec3f(2, 3, 1), 0.6f));
}

/// Rays through the whole scene, and as many through its dense part.
std::vector<Ray> raysFor(std::span<const CubeSplat> splats) {
    const double finest = std::ranges::min_element(splats, {}, &CubeSplat::radius)->radius;
    std::vector<CubeSplat> dense;
    std::ranges::copy_if(splats, std::back_inserter(dense), [&](const CubeSplat& s) { return s.radius < 2 * finest; });
    std::vector<Ray> rays = randomRays(boundingSphere(splats), kUnevenRays, 1);
    const Sphere part = boundingSphere(dense);
    for (const std::vector<Ray>& more : {randomRays(part, kUnevenRays, 2), grazingRays(dense, kUnevenRays, 3)})
        rays.insert(rays.end(), more.begin(), more.end());
    return rays;
}

struct Uneven {
    std::vector<CubeSplat> splats;
    std::vector<Ray> rays;
    std::vector<CastHit> hits;
    NearRounding rounding;
    bool cut = false; ///< whether cells are subdivided
};

Uneven castUneven(const Splats& scene) {
    const std::string path = temporaryPath("uneven.pro");
    writeScene(path, scene, {});
    Uneven result;
    result.splats = loadCubeSplats(path);
    result.rays = raysFor(result.splats);
    RayCaster caster(path);
    result.hits = caster.cast(result.rays);
    result.rounding = nearRounding(result.splats, caster.cellEdge());
    result.cut = caster.isUneven();
    std::remove(path.c_str());
    return result;
}

TEST(Uneven, FirstHitsMatchEmbree) {
    const Uneven scene = castUneven(bodyOnSheet());
    EXPECT_TRUE(scene.cut);
    const FirstHitCheck check = checkFirstHits(scene.splats, scene.rounding, scene.rays, scene.hits,
                                               EmbreeDiscs(scene.splats).cast(scene.rays));
    std::printf("%zu rays, %zu hits, %.4f agree, rim %zu, tie %zu, rounding %zu, unexplained %zu\n", check.rays,
                check.hits, check.agreement(), check.count(Verdict::kRim), check.count(Verdict::kTie),
                check.count(Verdict::kRounding), check.unexplained.size());
    EXPECT_GT(check.hits, kUnevenRays);
    EXPECT_EQ(check.unexplained.size(), 0u);
    EXPECT_GT(check.agreement(), 0.88); // half of the rays graze discs in nearly one plane
}

TEST(Uneven, FirstHitsMatchBruteForce) {
    const Uneven scene = castUneven(bodyOnSheet());
    std::size_t unexplained = 0;
    for (std::size_t i = 0; i < scene.rays.size(); i += 10) { // each against all splats
        const CastHit& hit = scene.hits[i];
        const std::optional<double> t = hit.hit() ? std::optional(hit.t_flat) : std::nullopt;
        unexplained += !mayBeFirst(scene.splats, scene.rounding, scene.rays[i], t);
    }
    EXPECT_EQ(unexplained, 0u);
}

} // namespace

} // namespace pointrt::test

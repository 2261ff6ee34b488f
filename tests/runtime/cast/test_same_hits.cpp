// SPDX-License-Identifier: Apache-2.0
// Ray casts give the hits of the renderer, for the same rays.
#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "pointrt/trace.hpp"
#include "tests/runtime/rays/ray_scenes.h"
#include "tests/support/ray_caster.h"
#include "tests/support/temporary_folder.h"

namespace pointrt::test {
namespace {

/// A sphere in a cloud of random discs.
std::vector<pro_splat> crowd() {
    std::vector<pro_splat> splats = sphereSplats(1500, 0.2f);
    std::mt19937 random(6);
    std::uniform_real_distribution<float> unit(0.1f, 0.9f);
    std::normal_distribution<float> gauss;
    for (int i = 0; i < 1500; ++i) {
        const float n[3] = {gauss(random), gauss(random), gauss(random)};
        const float size = std::sqrt(n[0] * n[0] + n[1] * n[1] + n[2] * n[2]);
        splats.push_back({{unit(random), unit(random), unit(random)},
                          {n[0] / size, n[1] / size, n[2] / size},
                          0.02f,
                          {90, 90, 90},
                          0});
    }
    return splats;
}

TEST(SameHits, MatchTheRenderer) {
    const TemporaryFolder folder;
    const std::string path = folder.file("crowd.pro");
    writeScan(path, crowd(), {{0, 0, 0}, 1});
    RayCaster pictures(path);
    const TraceDevice device;
    const TraceScene scene(device, {path});
    const std::vector<Ray> rays = randomRays(boundingSphere(loadCubeSplats(path)), 30000, 7);
    std::vector<double> rows, t(rays.size());
    std::vector<std::uint32_t> splats(rays.size());
    for (const Ray& ray : rays)
        rows.insert(rows.end(),
                    {ray.origin.x, ray.origin.y, ray.origin.z, ray.direction.x, ray.direction.y, ray.direction.z});
    scene.castRays(std::span<const double>(rows), {}, {.t_hit = t, .splat_ids = splats});
    const std::vector<CastHit> expected = pictures.cast(rays);
    std::size_t hits = 0, others = 0;
    for (std::size_t i = 0; i < rays.size(); ++i) {
        hits += expected[i].hit();
        others += splats[i] != expected[i].splat;
        if (expected[i].hit() && splats[i] == expected[i].splat) {
            ASSERT_NEAR(t[i], expected[i].t_flat, 1e-5) << i; // at grazing angles rounding changes the length
        }
    }
    EXPECT_GT(hits, rays.size() / 4);
    EXPECT_LE(others, 10u); // rims, where the last bit decides: the rays start at other points
}

} // namespace
} // namespace pointrt::test

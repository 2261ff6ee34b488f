// SPDX-License-Identifier: Apache-2.0
// Changes of the shaders' hits by pruning, compared with the bounds that it promises.
#include <gtest/gtest.h>

#include <cstdio>

#include "tests/support/pruning_change.h"
#include "tests/support/rays.h"
#include "tests/support/splat_scenes.h"

namespace pointrt::test {

namespace {

constexpr std::size_t kPruningRays = 50'000;

/// A sphere and a sheet that cuts it: smooth, creased and open parts.
Splats scene() {
    return joinSplats(sphereSplats(20000, Vec3f(0, 0, 0), 1.0f, 1.5f),
                      squareSplats(60, Vec3f(0.2f, 0, 0), Vec3f(1.2f, 0, 0.3f), Vec3f(0, 1.2f, 0), 1.5f));
}

TEST(Pruning, HitsAreUnchangedWithinItsBounds) {
    const std::string full_path = temporaryPath("full.pro"), pruned_path = temporaryPath("pruned.pro");
    BuildOptions options;
    const Built full = writeScene(full_path, scene(), options);
    options.prune = true;
    const Built pruned = writeScene(pruned_path, scene(), options);
    EXPECT_LT(pruned.octree.refs.size(), full.octree.refs.size());

    const std::vector<CubeSplat> splats = loadCubeSplats(full_path);
    std::vector<Ray> rays = randomRays(boundingSphere(splats), kPruningRays, 1);
    const std::vector<Ray> grazing = grazingRays(splats, kPruningRays, 1);
    rays.insert(rays.end(), grazing.begin(), grazing.end());
    const PruningChange change =
        measurePruning(splats, rays, RayCaster(full_path).cast(rays), RayCaster(pruned_path).cast(rays));
    std::remove(full_path.c_str());
    std::remove(pruned_path.c_str());

    std::printf("lost %zu, gained %zu, moved: flat %zu along the normal, blended %zu, along the ray %zu\n", change.lost,
                change.gained, change.flat.moved_along_normal, change.blended.moved_along_normal,
                change.blended.moved_along_ray);
    EXPECT_GT(change.hits_both, kPruningRays);
    EXPECT_EQ(change.lost + change.gained, 0u);
    // Pruning promises less than 1 in 10,000; three times that is allowed, as the variance of so few rays is high. Hits
    // are compared along the normal: cells with other discs round them differently, so a grazing ray may hit another
    // disc in nearly the same plane, far away along the ray.
    constexpr double kMax = 3e-4 * 2 * kPruningRays;
    EXPECT_LE(static_cast<double>(change.flat.moved_along_normal), kMax);
    EXPECT_LE(static_cast<double>(change.blended.moved_along_normal), kMax / 3);
    EXPECT_LE(static_cast<double>(change.blended.moved_along_ray), 2 * kMax);
    EXPECT_LT(change.blended.angle_p999, 0.36);
}

} // namespace

} // namespace pointrt::test

// SPDX-License-Identifier: Apache-2.0
// Ray queries over boxes of cells hit what the walk hits. Skipped on devices without ray queries.
#include <gtest/gtest.h>

#include <memory>
#include <string>

#include "format/base/error.h"
#include "tests/support/ray_caster.h"
#include "tests/support/splat_scenes.h"

namespace pointrt::test {
namespace {

constexpr std::size_t kQueriedRays = 10'000;

std::unique_ptr<RayCaster> casterFor(const std::string& path, Traversal traversal) {
    DeviceRequest request;
    request.traversal = traversal;
    return std::make_unique<RayCaster>(path, request);
}

/// A sheet of sparse splats and a dense body on it, so that cells are subdivided.
std::string unevenScene() {
    const std::string path = temporaryPath("ray_queries.pro");
    writeScene(path,
               joinSplats(squareSplats(30, Vec3f(0, 0, 0), Vec3f(10, 0, 0), Vec3f(0, 10, 1), 1.2f),
                          sphereSplats(12000, Vec3f(2, 3, 1), 0.6f)),
               {});
    return path;
}

class RayQueries : public testing::Test {
protected:
    void SetUp() override {
        path_ = unevenScene();
        try {
            hardware_ = casterFor(path_, Traversal::kHardware);
        } catch (const Error& error) {
            GTEST_SKIP() << error.what();
        }
        walk_ = casterFor(path_, Traversal::kWalk);
        const std::vector<CubeSplat> splats = loadCubeSplats(path_);
        rays_ = randomRays(boundingSphere(splats), kQueriedRays, 1);
        for (const Ray& each : grazingRays(splats, kQueriedRays, 2)) rays_.push_back(each);
    }

    std::string path_;
    std::unique_ptr<RayCaster> hardware_, walk_;
    std::vector<Ray> rays_;
};

// Cells round their copies of a splat. If a grazing ray hits two splats within that rounding, either may be the
// closest.
constexpr double kTieShare = 2e-3;

TEST_F(RayQueries, FindTheClosestHitsOfTheWalk) {
    const std::vector<CastHit> expected = walk_->cast(rays_), hits = hardware_->cast(rays_);
    std::size_t found = 0, others = 0;
    for (std::size_t i = 0; i < rays_.size(); ++i) {
        EXPECT_EQ(hits[i].hit(), expected[i].hit()) << i;
        found += expected[i].hit() ? 1 : 0;
        others += hits[i].splat != expected[i].splat ? 1 : 0;
    }
    EXPECT_GT(found, rays_.size() / 4);
    EXPECT_LE(others, static_cast<std::size_t>(kTieShare * static_cast<double>(rays_.size())));
}

TEST_F(RayQueries, FindAnyHitWhereTheWalkDoes) {
    walk_->load(rays_);
    hardware_->load(rays_);
    walk_->traceLoaded(true);
    hardware_->traceLoaded(true);
    const std::vector<CastHit> expected = walk_->loadedHits(), hits = hardware_->loadedHits();
    for (std::size_t i = 0; i < rays_.size(); ++i) EXPECT_EQ(hits[i].hit(), expected[i].hit()) << i;
}

} // namespace
} // namespace pointrt::test

// SPDX-License-Identifier: Apache-2.0
// Ray casts at Gaussians against brute force in double precision: a ray hits where half of its light is hidden.
#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <string>
#include <vector>

#include "pointrt/trace.hpp"
#include "runtime/gpu/device.h"
#include "tests/gaussians/nasty_gaussians.h"
#include "tests/runtime/rays/ray_scenes.h"
#include "tests/runtime/rays/set_scenes.h"
#include "tests/trace/gaussian_file.h"

namespace pointrt::test {
namespace {

constexpr std::size_t kGaussianRays = 2000;

/// Rays from points around the Gaussians, some from among them, towards other points; directions of any length.
std::vector<double> raysAmongGaussians() {
    std::mt19937 random(7);
    std::normal_distribution<double> normal;
    std::vector<double> rays;
    for (std::size_t i = 0; i < kGaussianRays; ++i) {
        const Vec3 from = (i % 3 == 0 ? 0.5 : 3.0) * Vec3{normal(random), normal(random), normal(random)};
        const Vec3 to = 0.5 * Vec3{normal(random), normal(random), normal(random)};
        addRay(rays, from, std::exp(normal(random)) * normalize(to - from));
    }
    return rays;
}

/// Distances in lengths of the direction; infinity for a miss.
std::vector<double> trueDistances(const OracleScene& scene, const std::vector<double>& rays) {
    std::vector<double> distances;
    for (std::size_t i = 0; i < rays.size(); i += 6) {
        const Vec3 direction{rays[i + 3], rays[i + 4], rays[i + 5]};
        const OracleComposite truth = compositeAlong(scene, {rays[i], rays[i + 1], rays[i + 2]}, normalize(direction));
        distances.push_back(truth.depth / length(direction));
    }
    return distances;
}

/// Hits and occlusions are as expected except for one in a hundred, where rounding decides whether a ray passes the
/// half.
void expectDistances(const TraceScene& scene, const std::vector<double>& rays, const std::vector<double>& expected) {
    std::vector<double> t(kGaussianRays);
    std::vector<std::uint32_t> splats(kGaussianRays);
    std::vector<float> normals(3 * kGaussianRays);
    std::vector<std::uint8_t> occluded(kGaussianRays);
    scene.castRays(std::span<const double>(rays), {}, {.t_hit = t, .splat_ids = splats, .normals = normals});
    scene.testOcclusions(std::span<const double>(rays), {}, occluded);
    std::size_t others = 0, hits = 0;
    for (std::size_t i = 0; i < kGaussianRays; ++i) {
        const bool is_hit = std::isfinite(expected[i]);
        hits += is_hit;
        EXPECT_EQ(std::isfinite(t[i]), splats[i] != kNoHit);
        others += occluded[i] != is_hit || std::isfinite(t[i]) != is_hit ||
                  (is_hit && std::abs(t[i] - expected[i]) > 1e-4 * (1 + expected[i]));
        if (!std::isfinite(t[i])) continue;
        const Vec3 normal{normals[3 * i], normals[3 * i + 1], normals[3 * i + 2]};
        EXPECT_NEAR(length(normal), 1, 1e-3);
        EXPECT_LE(dot(normal, {rays[6 * i + 3], rays[6 * i + 4], rays[6 * i + 5]}), 0);
    }
    EXPECT_GT(hits, kGaussianRays / 100); // few needles are hit
    EXPECT_LE(others, hits / 100);
}

class CastGaussians : public testing::TestWithParam<std::string> {
protected:
    TraceDevice device;
    std::uint64_t messages_ = validationMessages();
    void TearDown() override { EXPECT_EQ(validationMessages(), messages_); }
};

TEST_P(CastGaussians, HitWhereHalfIsHidden) {
    const GaussianFile file(makeGaussians(GetParam(), 1000));
    const std::vector<double> rays = raysAmongGaussians();
    const std::vector<double> expected = trueDistances(file.scene, rays);
    expectDistances(TraceScene(device, {file.path}), rays, expected);
}

// Rays of several instances are packed by the host.
TEST_P(CastGaussians, HitAmongSeveralInstances) {
    const GaussianFile file(makeGaussians(GetParam(), 1000));
    const GaussianFile other({roundGaussian({0, 0, 500}, 0.01, 0.9, {1, 1, 1})});
    const std::vector<double> rays = raysAmongGaussians();
    expectDistances(TraceScene(device, {other.path, file.path}), rays, trueDistances(file.scene, rays));
}

INSTANTIATE_TEST_SUITE_P(Each, CastGaussians, testing::Values("random", "giants", "needles", "mixed"),
                         [](const auto& kind) { return kind.param; });

} // namespace
} // namespace pointrt::test

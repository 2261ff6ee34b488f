// SPDX-License-Identifier: Apache-2.0
// The library's ray casts against independent calculations.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <thread>

#include "pointrt/trace.hpp"
#include "runtime/gpu/device.h"
#include "runtime/util/vec.h"
#include "tests/runtime/rays/ray_scenes.h"
#include "tests/runtime/rays/set_scenes.h"
#include "tests/support/temporary_folder.h"

namespace pointrt::test {
namespace {

constexpr double kMiss = std::numeric_limits<double>::infinity();

/// Hits of rays, with all arrays.
struct Hits {
    explicit Hits(std::size_t count)
        : t_hit(count), positions(3 * count), splat_ids(count), instance_ids(count), normals(3 * count) {}
    HitArrays arrays() { return {t_hit, splat_ids, instance_ids, normals, positions}; }
    Vec3 position(std::size_t i) const { return {positions[3 * i], positions[3 * i + 1], positions[3 * i + 2]}; }
    Vec3 normal(std::size_t i) const { return {normals[3 * i], normals[3 * i + 1], normals[3 * i + 2]}; }

    std::vector<double> t_hit, positions;
    std::vector<std::uint32_t> splat_ids, instance_ids;
    std::vector<float> normals;
};

Hits cast(const TraceScene& scene, const std::vector<double>& rays, const RayLimits& limits = {}) {
    Hits hits(rays.size() / 6);
    scene.castRays(std::span<const double>(rays), limits, hits.arrays());
    return hits;
}

/// Fails on messages of the validation layer.
class Cast : public testing::Test {
protected:
    void TearDown() override { EXPECT_EQ(validationMessages(), messages_); }

    std::string scan(const std::string& name, const std::vector<pro_splat>& splats, const GridPlace& place = {}) {
        writeScan(folder.file(name), splats, place);
        return folder.file(name);
    }

    TemporaryFolder folder;
    TraceDevice device;
    std::uint64_t messages_ = validationMessages();
};

/// Rays onto a plane from up to 1000 km away, at up to 60 degrees from the normal, with directions of any length.
std::vector<double> slantedRays(std::size_t count, const GridPlace& place, double height) {
    std::mt19937 random(1);
    std::uniform_real_distribution<double> unit(0, 1);
    std::vector<double> rays;
    for (std::size_t i = 0; i < count; ++i) {
        const Vec3 target{place.origin[0] + place.edge * (0.15 + 0.7 * unit(random)),
                          place.origin[1] + place.edge * (0.15 + 0.7 * unit(random)), height};
        const double angle = 2 * std::numbers::pi * unit(random), lean = std::tan(std::numbers::pi / 3) * unit(random);
        const Vec3 away = normalize({lean * std::cos(angle), lean * std::sin(angle), 1});
        const double distance = 1 + 1e6 * unit(random) * unit(random), size = std::exp(10 * unit(random) - 5);
        addRay(rays, target + distance * away, (-size) * away);
    }
    return rays;
}

TEST_F(Cast, GridCoordinates_PlaneIsExact) {
    const GridPlace place;
    const std::vector<pro_splat> splats = planeSplats(40, 0.5f);
    const double radius = place.edge * splats[0].radius;
    const TraceScene scene(device, {scan("plane.pro", splats, place)});
    const double height = place.origin[2] + place.edge * (0.5 + 0.5 * 0x1p-21); // by the quantisation of positions
    const std::vector<double> rays = slantedRays(5000, place, height);
    const Hits hits = cast(scene, rays);
    for (std::size_t i = 0; i < hits.t_hit.size(); ++i) {
        const double expected = (height - rays[6 * i + 2]) / rays[6 * i + 5];
        const double length_of = length({rays[6 * i + 3], rays[6 * i + 4], rays[6 * i + 5]});
        ASSERT_NEAR(hits.t_hit[i] * length_of, expected * length_of, 1e-3 * radius) << i;
        ASSERT_NEAR(hits.position(i).z, height, 1e-3 * radius) << i;
        ASSERT_EQ(hits.position(i).x, rays[6 * i] + hits.t_hit[i] * rays[6 * i + 3]) << i;
        ASSERT_EQ(hits.instance_ids[i], 0u);
        ASSERT_LT(hits.splat_ids[i], scene.splatCount());
        ASSERT_GT(hits.normal(i).z, 0.999) << i;
    }
}

/// A disc in doubles, from its quantised splat.
struct Disc {
    Vec3 center, normal;
    double radius = 0;
};

std::vector<Disc> discsOf(const std::string& path) {
    const ProFile file(path);
    std::vector<Disc> discs;
    for (std::size_t i = 0; i < file.info().splat_count; ++i) {
        const pro_splat s = file.splat(i);
        const double edge = file.info().scale;
        const double* o = file.info().origin;
        discs.push_back({{o[0] + edge * s.position[0], o[1] + edge * s.position[1], o[2] + edge * s.position[2]},
                         normalize({s.normal[0], s.normal[1], s.normal[2]}),
                         edge * s.radius});
    }
    return discs;
}

double meet(const Disc& disc, Vec3 origin, Vec3 direction) {
    return dot(disc.normal, disc.center - origin) / dot(disc.normal, direction);
}

TEST_F(Cast, GridCoordinates_SphereIsItsDiscs) {
    const GridPlace place;
    const float radius = 0.4f;
    const std::string path = scan("sphere.pro", sphereSplats(6000, radius), place);
    const TraceScene scene(device, {path});
    const std::vector<Disc> discs = discsOf(path);
    const Vec3 center{place.origin[0] + 64, place.origin[1] + 64, place.origin[2] + 64};
    const double sphere = place.edge * radius;
    std::mt19937 random(2);
    std::normal_distribution<double> gauss;
    std::vector<double> rays;
    for (int i = 0; i < 4000; ++i) {
        const Vec3 away = normalize({gauss(random), gauss(random), gauss(random)});
        const Vec3 aside = normalize(cross(away, {gauss(random), gauss(random), gauss(random)}));
        addRay(rays, center + 700.0 * away + 0.5 * sphere * aside, (-3.0) * away);
    }
    const Hits hits = cast(scene, rays);
    for (std::size_t i = 0; i < hits.t_hit.size(); ++i) {
        const Vec3 origin{rays[6 * i], rays[6 * i + 1], rays[6 * i + 2]},
            direction{rays[6 * i + 3], rays[6 * i + 4], rays[6 * i + 5]};
        ASSERT_LT(hits.splat_ids[i], discs.size()) << i;
        const Disc& disc = discs[hits.splat_ids[i]];
        ASSERT_NEAR(3 * hits.t_hit[i], 3 * meet(disc, origin, direction), 1e-3 * disc.radius) << i;
        ASSERT_LT(length(hits.position(i) - disc.center), 1.02 * disc.radius) << i; // the discs of cells are quantised
        // a disc is outside the sphere by at most its sagitta, and a ray at 30 degrees hits it even earlier
        const double sagitta = disc.radius * disc.radius / (2 * sphere);
        const double true_t = (700.0 - sphere * std::sqrt(0.75)) / 3;
        ASSERT_NEAR(3 * hits.t_hit[i], 3 * true_t, 1.5 * sagitta / std::sqrt(0.75)) << i;
        ASSERT_LT(length(hits.normal(i) - normalize(hits.position(i) - center)), 1.1 * disc.radius / sphere) << i;
    }
}

TEST_F(Cast, Normals_FaceTheRay) {
    const TraceScene scene(device, {scan("plane.pro", planeSplats(10, 0.5f))});
    std::vector<double> rays;
    addRay(rays, {500064, 4500064, 90}, {0, 0, 2});
    const Hits hits = cast(scene, rays);
    EXPECT_NEAR(hits.t_hit[0], 37, 1e-4);
    EXPECT_LT(hits.normal(0).z, -0.999);
}

TEST_F(Cast, Misses_AreMarkedInEachArray) {
    const TraceScene scene(device, {scan("plane.pro", planeSplats(10, 0.5f))});
    std::vector<double> rays;
    addRay(rays, {500064, 4500064, 300}, {0, 0, 1});  // away
    addRay(rays, {500002, 4500002, 300}, {0, 0, -1}); // beside the splats, within the cube
    addRay(rays, {600000, 4500064, 300}, {0, 0, -1}); // beside the cube
    addRay(rays, {500064, 4500064, 101}, {1, 0, 0});  // below, along the plane
    addRay(rays, {1e300, 0, 0}, {1e-300, 0, 0});
    const Hits hits = cast(scene, rays);
    for (std::size_t i = 0; i < hits.t_hit.size(); ++i) {
        EXPECT_EQ(hits.t_hit[i], kMiss) << i;
        EXPECT_EQ(hits.splat_ids[i], 4294967295u) << i;
        EXPECT_EQ(hits.instance_ids[i], 4294967295u) << i;
        EXPECT_EQ(hits.normal(i), Vec3{}) << i;
        EXPECT_TRUE(std::isnan(hits.position(i).x) && std::isnan(hits.position(i).z)) << i;
    }
}

TEST_F(Cast, Limits_ExcludeHitsOutside) {
    std::vector<pro_splat> floors = planeSplats(12, 0.25f);
    for (const pro_splat& upper : planeSplats(12, 0.75f)) floors.push_back(upper);
    const TraceScene scene(device, {scan("floors.pro", floors)});
    std::vector<double> rays;
    addRay(rays, {500064, 4500064, 356}, {0, 0, -2}); // from 256 above the ground: hits at t 80 and 112
    const double upper = 80, lower = 112;
    EXPECT_NEAR(cast(scene, rays).t_hit[0], upper, 1e-3);
    EXPECT_EQ(cast(scene, rays, {0, 79.9}).t_hit[0], kMiss);
    EXPECT_NEAR(cast(scene, rays, {0, 80.1}).t_hit[0], upper, 1e-3);
    EXPECT_NEAR(cast(scene, rays, {80.1, kMiss}).t_hit[0], lower, 1e-3);
    EXPECT_EQ(cast(scene, rays, {80.1, 111.9}).t_hit[0], kMiss);
    EXPECT_EQ(cast(scene, rays, {112.1, kMiss}).t_hit[0], kMiss);
    std::uint8_t blocked = 7;
    const std::span<const double> one(rays);
    scene.testOcclusions(one, {80.1, 111.9}, {&blocked, 1});
    EXPECT_EQ(blocked, 0);
    scene.testOcclusions(one, {80.1, 112.1}, {&blocked, 1});
    EXPECT_EQ(blocked, 1);
}

/// Lines through the cube at place, from around it.
std::vector<double> anyRays(std::size_t count, const GridPlace& place, unsigned seed) {
    std::mt19937 random(seed);
    std::uniform_real_distribution<double> unit(0, 1);
    std::normal_distribution<double> gauss;
    std::vector<double> rays;
    for (std::size_t i = 0; i < count; ++i) {
        const Vec3 through{place.origin[0] + place.edge * unit(random), place.origin[1] + place.edge * unit(random),
                           place.origin[2] + place.edge * unit(random)};
        const Vec3 direction = normalize({gauss(random), gauss(random), gauss(random)});
        addRay(rays, through - 2 * place.edge * direction, direction);
    }
    return rays;
}

TEST_F(Cast, Occlusions_MatchHits) {
    const TraceScene scene(device, {scan("sphere.pro", sphereSplats(500, 0.3f))});
    const std::vector<double> rays = anyRays(20000, {}, 3);
    const Hits hits = cast(scene, rays);
    std::vector<std::uint8_t> occluded(hits.t_hit.size());
    scene.testOcclusions(std::span<const double>(rays), {}, occluded);
    std::size_t blocked = 0;
    for (std::size_t i = 0; i < occluded.size(); ++i) {
        ASSERT_EQ(occluded[i] != 0, std::isfinite(hits.t_hit[i])) << i;
        blocked += occluded[i];
    }
    EXPECT_GT(blocked, 2000u);
    EXPECT_LT(blocked, 18000u);
}

TEST_F(Cast, DistantOrigins_LoseNoPrecision) {
    const GridPlace place;
    const std::vector<pro_splat> splats = planeSplats(40, 0.5f);
    const TraceScene scene(device, {scan("plane.pro", splats, place)});
    const double height = place.origin[2] + place.edge * (0.5 + 0.5 * 0x1p-21);
    for (const double distance : {1e3, 1e5, 1e7, 1e9}) { // the precision of the origin decreases
        const double away = std::exp2(std::floor(std::log2(distance)));
        std::vector<double> rays;
        addRay(rays, {place.origin[0] + 64 + away, place.origin[1] + 64, height + away}, {-1, 0, -1});
        addRay(rays, {place.origin[0] + 64 + away, place.origin[1] + 64, height + away}, {1, 0, 1});
        addRay(rays, {place.origin[0] + 64, place.origin[1] + 64, height + away}, {0, 0, -3});
        const Hits hits = cast(scene, rays);
        EXPECT_NEAR(hits.t_hit[0], away, 1e-3 * place.edge * splats[0].radius + 2 * away * 0x1p-52) << away;
        EXPECT_EQ(hits.t_hit[1], kMiss) << away;
        EXPECT_NEAR(hits.t_hit[2] * 3, away, 1e-3 * place.edge * splats[0].radius + 2 * away * 0x1p-52) << away;
    }
}

TEST_F(Cast, RescaledRays_DoNotAffectOthers) {
    const TraceScene scene(device, {scan("sphere.pro", sphereSplats(500, 0.3f))});
    std::vector<double> rays = anyRays(3000, {}, 6);
    const Hits expected = cast(scene, rays);
    for (const std::size_t odd : {7u, 1500u, 2999u}) // too short and too long for floats, the second also in its square
        for (std::size_t k = 3; k < 6; ++k) rays[6 * odd + k] *= odd == 7 ? 1e-180 : 1e180;
    const Hits hits = cast(scene, rays);
    EXPECT_EQ(hits.splat_ids, expected.splat_ids);
    for (std::size_t i = 0; i < hits.t_hit.size(); ++i) {
        const double size = i == 7 ? 1e-180 : i == 1500 || i == 2999 ? 1e180 : 1;
        if (std::isfinite(expected.t_hit[i])) {
            ASSERT_NEAR(hits.t_hit[i] * size, expected.t_hit[i], 1e-3) << i;
        }
    }
    std::vector<std::uint8_t> occluded(hits.t_hit.size());
    scene.testOcclusions(std::span<const double>(rays), {}, occluded);
    for (std::size_t i = 0; i < occluded.size(); ++i)
        ASSERT_EQ(occluded[i] != 0, std::isfinite(expected.t_hit[i])) << i;
}

TEST_F(Cast, FloatRays_MatchDoubles) {
    const GridPlace near_zero{{0, 0, 0}, 2};
    const TraceScene scene(device, {scan("sphere.pro", sphereSplats(500, 0.3f), near_zero)});
    std::vector<float> floats;
    for (const double number : anyRays(3000, near_zero, 4)) floats.push_back(static_cast<float>(number));
    const Hits expected = cast(scene, {floats.begin(), floats.end()});
    Hits hits(expected.t_hit.size());
    scene.castRays(std::span<const float>(floats), {}, hits.arrays());
    EXPECT_EQ(hits.t_hit, expected.t_hit);
    EXPECT_EQ(hits.splat_ids, expected.splat_ids);
    EXPECT_EQ(hits.normals, expected.normals);
}

TEST_F(Cast, SeveralScans_NearestIsHit) {
    const GridPlace left, right{{500200, 4500000, 100}, 32};
    const TraceScene scene(device, {scan("left.pro", planeSplats(20, 0.5f), left),
                                    scan("right.pro", planeSplats(20, 0.5f), right),
                                    scan("over.pro", planeSplats(20, 0.75f), left)});
    std::vector<double> rays;
    addRay(rays, {500064, 4500064, 300}, {0, 0, -1}); // over is above left
    addRay(rays, {500064, 4500064, 90}, {0, 0, 1});   // from below, left comes first
    addRay(rays, {500216, 4500016, 300}, {0, 0, -1});
    addRay(rays, {500180, 4500016, 300}, {0, 0, -1}); // between
    const Hits hits = cast(scene, rays);
    EXPECT_EQ(hits.instance_ids, (std::vector<std::uint32_t>{2, 0, 1, kNoHit}));
    EXPECT_NEAR(hits.t_hit[0], 104, 1e-3);
    EXPECT_NEAR(hits.t_hit[1], 74, 1e-3);
    EXPECT_NEAR(hits.t_hit[2], 184, 1e-3);
    EXPECT_EQ(hits.t_hit[3], kMiss);
    std::vector<std::uint8_t> occluded(4);
    scene.testOcclusions(std::span<const double>(rays), {}, occluded);
    EXPECT_EQ(occluded, (std::vector<std::uint8_t>{1, 1, 1, 0}));
}

TEST_F(Cast, Threads_GetTheSameHits) {
    const TraceScene scene(device, {scan("sphere.pro", sphereSplats(500, 0.3f))});
    const std::vector<double> some = anyRays(1000, {}, 5);
    const Hits expected = cast(scene, some);
    constexpr std::size_t kTurns = 300; // more rays than a chunk holds, and not a multiple of it
    std::vector<double> rays;
    for (std::size_t turn = 0; turn < kTurns; ++turn) rays.insert(rays.end(), some.begin(), some.end());
    std::vector<std::jthread> threads;
    std::vector<std::size_t> wrong(8, 1);
    for (std::size_t k = 0; k < wrong.size(); ++k)
        threads.emplace_back([&, k] {
            const Hits hits = cast(scene, k % 2 == 0 ? rays : some);
            wrong[k] = 0;
            for (std::size_t i = 0; i < hits.t_hit.size(); ++i)
                wrong[k] +=
                    hits.t_hit[i] != expected.t_hit[i % 1000] || hits.splat_ids[i] != expected.splat_ids[i % 1000];
        });
    threads.clear();
    EXPECT_EQ(wrong, std::vector<std::size_t>(8, 0));
}

TEST_F(Cast, Scenes_CanBeOpenedFromSeveralThreads) {
    const std::string path = scan("plane.pro", planeSplats(10, 0.5f));
    const auto work = [&] {
        for (int turn = 0; turn < 20; ++turn) {
            const TraceScene scene(device, {path});
            std::vector<double> rays;
            addRay(rays, {500064, 4500064, 300}, {0, 0, -1});
            ASSERT_NEAR(cast(scene, rays).t_hit[0], 136, 1e-3);
        }
    };
    std::jthread other(work);
    work();
}

TEST_F(Cast, Scene_OutlivesItsDeviceObject) {
    TraceDevice mine;
    const TraceScene scene(mine, {scan("plane.pro", planeSplats(10, 0.5f))});
    mine = TraceDevice();
    std::vector<double> rays;
    addRay(rays, {500064, 4500064, 300}, {0, 0, -1});
    EXPECT_NEAR(cast(scene, rays).t_hit[0], 136, 1e-3);
}

TEST_F(Cast, NoRays_AreAccepted) {
    const TraceScene scene(device, {scan("plane.pro", planeSplats(4, 0.5f))});
    EXPECT_TRUE(cast(scene, {}).t_hit.empty());
}

} // namespace
} // namespace pointrt::test

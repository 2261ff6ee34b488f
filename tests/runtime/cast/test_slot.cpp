// SPDX-License-Identifier: Apache-2.0
// Chunks of rays, also through scans whose buffers have several pages.
#include <gtest/gtest.h>

#include <algorithm>
#include <random>

#include "runtime/cast/describe_instances.h"
#include "runtime/cast/given_rays.h"
#include "shaders/shared/params.h"
#include "tests/runtime/rays/ray_scenes.h"
#include "tests/support/temporary_folder.h"
#include "tests/support/validated_device.h"

namespace pointrt::test {
namespace {

struct Found {
    std::vector<std::uint32_t> splats, occluded;
    bool paged = false;
};

/// Casts vertical rays on a grid over the cube of a scan, in two runs.
Found castDown(Device& device, const std::string& path) {
    constexpr std::size_t kSide = 64, kCount = kSide * kSide;
    InstanceResidency resident(device, describeInstances({path}), 0);
    const ResidentInstance& target = *resident.find(0);
    CastPrograms programs(device);
    CastSlot slot = createSlot(device);
    for (std::size_t i = 0; i < kCount; ++i) {
        const auto place = [](std::size_t k) { return (static_cast<float>(k) + 0.5f) / kSide; };
        slot.rayRows(kCount)[i] = {{place(i % kSide), place(i / kSide), 0.9f}, 1, {0, 0, -1}, 0};
    }
    Found found;
    found.paged = isPaged(target.traits.pages);
    const CastRun runs[] = {{&target, 0, 1000}, {&target, 1000, kCount - 1000}};
    traceSlot(slot, programs, runs, false);
    for (const gpu::CastHit& hit : slot.hitRows(kCount)) found.splats.push_back(hit.splat);
    traceSlot(slot, programs, runs, true);
    const auto occluded = slot.occludedRows(kCount);
    found.occluded.assign(occluded.begin(), occluded.end());
    destroySlot(slot);
    return found;
}

/// Rays from outside towards random points of the cube at place; some directions are not of length 1.
std::vector<double> raysAround(const GridPlace& place, std::size_t count) {
    std::mt19937 random(9);
    std::uniform_real_distribution<double> unit(0, 1);
    std::vector<double> rows;
    for (std::size_t i = 0; i < count; ++i) {
        double through[3], away[3];
        for (std::size_t axis = 0; axis < 3; ++axis) {
            through[axis] = place.origin[axis] + place.edge * unit(random);
            away[axis] = place.edge * (unit(random) - 0.5);
        }
        for (std::size_t axis = 0; axis < 3; ++axis) rows.push_back(through[axis] + 3 * away[axis]);
        for (const double step : away) rows.push_back(i % 2 == 0 ? -step : -step / place.edge);
    }
    return rows;
}

TEST(CastSlot, Pages_GiveTheSameHits) {
    const TemporaryFolder folder;
    const std::string path = folder.file("sphere.pro");
    writeScan(path, sphereSplats(400, 0.4f), {});
    ValidatedDevice whole;
    DeviceRequest request;
    request.page_bits_most = 11;
    ValidatedDevice paged(request);
    const Found expected = castDown(whole.device, path), found = castDown(paged.device, path);
    EXPECT_FALSE(expected.paged);
    EXPECT_TRUE(found.paged);
    EXPECT_EQ(found.splats, expected.splats);
    EXPECT_EQ(found.occluded, expected.occluded);
    const auto misses = std::count(expected.splats.begin(), expected.splats.end(), NO_INDEX);
    EXPECT_GT(misses, 500);
    EXPECT_LT(misses, 3000);
}

TEST(CastSlot, CallersRays_GiveTheHitsOfPackedOnes) {
    const TemporaryFolder folder;
    const std::string path = folder.file("sphere.pro");
    writeScan(path, sphereSplats(400, 0.4f), {});
    ValidatedDevice validated;
    Device& device = validated.device;
    InstanceResidency resident(device, describeInstances({path}), 0);
    const ResidentInstance& target = *resident.find(0);
    if (!takesGiven(device, target)) GTEST_SKIP() << "the device has no 64-bit floats";
    const std::vector<double> rows = raysAround(GridPlace{}, 5000);
    const RayRows rays{std::span<const double>(rows)};
    const RayLimits limits{0.5, 300};
    CastPrograms programs(device);
    CastSlot slot = createSlot(device);
    const CastRun run{&target, 0, static_cast<std::uint32_t>(rays.count)};
    packRays(target.frame, rays, limits, 0, slot.rayRows(rays.count), std::span(slot.starts).first(rays.count));
    traceSlot(slot, programs, {&run, 1}, false);
    std::vector<RayHit> expected;
    for (std::size_t i = 0; i < rays.count; ++i)
        expected.push_back(hitOf(slot.hitRows(rays.count)[i], 0, slot.starts[i], limits, {}));
    GivenRays(device, rays).trace(slot, programs, target, limits, 0, rays.count, false);
    std::vector<double> t(rays.count);
    std::vector<std::uint32_t> splats(rays.count);
    EXPECT_TRUE(putGiven(slot, resident.list(), rays, 0, rays.count, {.t_hit = t, .splat_ids = splats}));
    const double radius = GridPlace{}.edge * static_cast<double>(sphereSplats(400, 0.4f)[0].radius);
    std::size_t hits = 0, others = 0;
    for (std::size_t i = 0; i < rays.count; ++i) {
        const bool is_hit = expected[i].instance == 0;
        hits += is_hit;
        others += splats[i] != (is_hit ? expected[i].splat : NO_INDEX);
        if (is_hit && splats[i] == expected[i].splat) {
            const double size = length({rows[6 * i + 3], rows[6 * i + 4], rows[6 * i + 5]});
            EXPECT_NEAR(t[i] * size, expected[i].t * size, 1e-4 * radius) << i;
        }
    }
    destroySlot(slot);
    EXPECT_GT(hits, 1000u);
    EXPECT_LT(hits, 4500u);
    EXPECT_LE(others, 5u); // rims, where the last bit decides
}

} // namespace
} // namespace pointrt::test

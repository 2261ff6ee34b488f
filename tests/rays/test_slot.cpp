// SPDX-License-Identifier: Apache-2.0
// Chunks of rays through scans whose buffers have several pages, as scans too large for one have.
#include <gtest/gtest.h>

#include <algorithm>

#include "runtime/trace/cast_slot.h"
#include "runtime/trace/targets/describe_targets.h"
#include "shaders/shared/params.h"
#include "tests/rays/ray_scenes.h"
#include "tests/support/temporary_folder.h"
#include "tests/support/validated_device.h"

namespace pointrt::test {
namespace {

struct Found {
    std::vector<std::uint32_t> splats, stopped;
    bool paged = false;
};

/// Rays straight down at the scan at path, in a grid over its cube, in two runs.
Found castDown(Device& device, const std::string& path) {
    constexpr std::size_t kSide = 64, kCount = kSide * kSide;
    ResidentTargets resident(device, describeTargets({path}), 0);
    const PlacedTarget& target = *resident.find(0);
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
    const auto stopped = slot.stoppedRows(kCount);
    found.stopped.assign(stopped.begin(), stopped.end());
    destroySlot(slot);
    return found;
}

TEST(CastSlot, FindsTheSameInPages) {
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
    EXPECT_EQ(found.stopped, expected.stopped);
    const auto misses = std::count(expected.splats.begin(), expected.splats.end(), NO_INDEX);
    EXPECT_GT(misses, 500);
    EXPECT_LT(misses, 3000);
}

} // namespace
} // namespace pointrt::test

// SPDX-License-Identifier: Apache-2.0
// Profiles of frames, compared with other counts of the same rays.
#include "runtime/render/pass_profile.h"

#include <gtest/gtest.h>

#include <chrono>
#include <stdexcept>
#include <string>

#include "runtime/render/loaded_scene.h"
#include "runtime/render/progressive_renderer.h"
#include "tests/support/ball_scene.h"
#include "tests/support/validated_device.h"

namespace pointrt {
namespace {

using Clock = std::chrono::steady_clock;

constexpr std::uint32_t kPassProfileSide = 40, kProfiledSamples = 2;

const PassTally& passNamed(const PassProfile& profile, const std::string& name) {
    for (const PassTally& each : profile.passes)
        if (each.name == name) return each;
    throw std::out_of_range(name);
}

class PassProfileTest : public DeviceFixture {
protected:
    void SetUp() override {
        LoadRequest request;
        request.scene = ballScene();
        request.settings.width = request.settings.height = kPassProfileSide;
        request.settings.spp = kProfiledSamples;
        request.settings.integrator = Integrator::kPath;
        request.settings.first_hits = true;
        request.form = KernelForm::kWavefront;
        loaded = loadScene(device, device, request, {});
        profile.clock = createPassClock(device);
    }
    void TearDown() override { destroyPassClock(device, profile.clock); }

    /// Measures into target, unless it is null.
    Film render(PassProfile* target) {
        loaded->tracer.profile = target;
        const Clock::time_point start = Clock::now();
        ProgressiveRenderer renderer(device, loaded->tracer);
        FrameJob job;
        job.samples = kProfiledSamples;
        renderer.begin({loaded->settings, loaded->camera, {kPassProfileSide, kPassProfileSide}}, job);
        renderer.run();
        rays = renderer.takeRays();
        Film film = renderer.takeFilm();
        profile.frames_ms += std::chrono::duration<double, std::milli>(Clock::now() - start).count();
        return film;
    }

    std::unique_ptr<LoadedScene> loaded;
    PassProfile profile;
    RayCounts rays;
};

TEST_F(PassProfileTest, CountsTheRaysOfTheFrame) {
    render(&profile);
    ASSERT_GT(rays.secondary, 0u);
    EXPECT_EQ(passNamed(profile, "shade_surface (camera)").lanes_in, rays.primary);
    EXPECT_EQ(rays.primary, kProfiledSamples * kPassProfileSide * kPassProfileSide);
    EXPECT_EQ(passNamed(profile, "shade_surface").lanes_in, rays.secondary);
    EXPECT_EQ(passNamed(profile, "intersect_shapes").lanes_in, rays.secondary);
    EXPECT_EQ(passNamed(profile, "intersect_shapes").lanes_out, 0u) << "the scene has no instances";
    EXPECT_EQ(passNamed(profile, "intersect_shadow_shapes").lanes_in, passNamed(profile, "shade_shadow").lanes_in);
    // secondary rays and direct light queries
    EXPECT_EQ(passNamed(profile, "shade_surface (camera)").lanes_out + passNamed(profile, "shade_surface").lanes_out,
              rays.secondary + passNamed(profile, "shade_shadow").lanes_in);
}

TEST_F(PassProfileTest, TimesAddUpToNoMoreThanTheFrame) {
    render(&profile);
    double passes_ms = 0;
    for (const PassTally& each : profile.passes) {
        EXPECT_GT(each.runs, 0u);
        EXPECT_GT(each.host_ms, 0) << each.name;
        passes_ms += each.host_ms;
        // two clocks, one of which may have a resolution of some microseconds
        EXPECT_LE(each.device_ms, 1.01 * each.host_ms + 0.01 * static_cast<double>(each.runs)) << each.name;
        EXPECT_EQ(each.device_ms > 0, profile.clock.timer.pool != VK_NULL_HANDLE) << each.name;
    }
    EXPECT_GE(unaccountedMilliseconds(profile), 0);
    EXPECT_LT(unaccountedMilliseconds(profile) + passes_ms, profile.frames_ms) << "frames also read the film back";
}

TEST_F(PassProfileTest, DoesNotChangeThePicture) {
    const Film without = render(nullptr);
    EXPECT_TRUE(profile.passes.empty() && profile.host.empty());
    const Film with = render(&profile);
    EXPECT_EQ(with.rgba, without.rgba);
    EXPECT_EQ(with.depth, without.depth);
}

TEST(PassProfile, CountsBytesByLanesAndEntries) {
    PassProfile profile;
    PassRun run{"intersect_closest", PassLanes::kList, 4, {}, {}, 3, 6, 2, LIST_INSTANCE_RAYS};
    run.before.lists[LIST_INSTANCE_RAYS].count = run.after.lists[LIST_INSTANCE_RAYS].count = 100;
    run.before.hit_count = 5;
    run.after.hit_count = 15;
    addRun(profile, run);
    ASSERT_EQ(profile.passes.size(), 1u);
    const PassTally& trace = profile.passes.front();
    EXPECT_EQ(trace.lanes_in, 100u);
    EXPECT_EQ(trace.lanes_out, 10u);
    // read: a word of the list, three vectors of the path, and the previous hit; written: a word and a vector per hit
    EXPECT_EQ(trace.bytes, 100u * (4 + 48 + 16) + 10u * (4 + 16));
    EXPECT_EQ(trace.host_ms, 3);
    EXPECT_EQ(trace.cpu_ms, 6);
    EXPECT_EQ(trace.device_ms, 2);
    EXPECT_THROW(addRun(profile, {"unheard of", PassLanes::kOne, 0, {}, {}, 0, 0, {}}), std::logic_error);
}

// After the first bounce, megakernels for one bounce do not touch the film's direct layer.
TEST(PassProfile, CountsTheDirectLayerWhereLightMayBeDirect) {
    for (const std::uint32_t step : {0u, STEP_DIRECT}) {
        PassProfile profile;
        PassRun run{"megakernel", PassLanes::kQueueZero, 4, {}, {}, 1, 0, {}};
        run.before.queued[0] = run.after.queued[0] = 100;
        run.step = step;
        addRun(profile, run);
        // read: a word of the queue, the path, its hit; read and written: one or two layers of the film
        EXPECT_EQ(profile.passes.front().bytes, 100u * (4 + 64 + 16 + (step ? 64 : 32)));
    }
}

TEST(PassProfile, EmptyingListsIsNotOutput) {
    PassProfile profile;
    PassRun run{"prepare", PassLanes::kOne, 4, {}, {}, 1, 0, {}};
    run.before.queued[0] = 12;
    addRun(profile, run);
    EXPECT_EQ(profile.passes.front().lanes_in, 1u);
    EXPECT_EQ(profile.passes.front().lanes_out, 0u);
}

} // namespace
} // namespace pointrt
